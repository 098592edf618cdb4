#include "reports/picture/record_picture.h"

#include <gtest/gtest.h>

namespace fracbench {
namespace {

/// A box between two corners; the face towards +x is fracture surface where `cracked`.
Fragment box(const Vec3& low, const Vec3& high, bool cracked) {
  Fragment fragment;
  for (int k = 0; k < 8; ++k) {
    fragment.mesh.vertices.emplace_back(k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(),
                                        k & 4 ? high.z() : low.z());
  }
  fragment.mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  fragment.faces.resize(12, {.original_face = 0});
  if (cracked) fragment.faces[10] = fragment.faces[11] = {.original_face = -1, .interface = 0};
  return fragment;
}

/// Share of the pixels that `is` holds for.
template <typename Predicate>
double share(const Picture& picture, const Predicate& is) {
  int count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    count += is(picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]);
  }
  return static_cast<double>(count) / (picture.width * picture.height);
}

double orange(const Picture& picture) {
  return share(picture, [](int r, int g, int b) { return r > 1.3 * g && g > 1.3 * b; });
}

double red(const Picture& picture) {
  return share(picture, [](int r, int g, int b) { return r > 2 * g && r > 2 * b; });
}

constexpr RecordPictureOptions kSmall{.width = 80, .height = 80};

TEST(FracturePicture, LooksAtTheFractureSurface) {
  const Fragment cracked = box({-1, -1, -1}, {1, 1, 1}, true);
  EXPECT_GT(orange(fracture_picture_of(cracked, kSmall)), 0.2);
  EXPECT_EQ(orange(fracture_picture_of(box({-1, -1, -1}, {1, 1, 1}, false), kSmall)), 0);
}

TEST(FracturePicture, IsOfTheFragmentThatHasMostOfIt) {
  const Fragments fragments = {box({-1, -1, -1}, {0, 0.5, 1}, true),
                               box({-1, -1, -1}, {0, 1, 1}, true),
                               box({-1, -9, -9}, {0, 9, 9}, false)};
  EXPECT_EQ(most_cracked(fragments), 1u);
  EXPECT_FALSE(most_cracked({fragments[2]}).has_value());
  EXPECT_FALSE(most_cracked({}).has_value());
}

TEST(CollisionPicture, HasAnArrowForEachImpulse) {
  const TriangleMesh target = box({-1, -1, -1}, {1, 1, 1}, false).mesh;
  Record record;
  EXPECT_EQ(red(collision_picture_of(record, target, kSmall)), 0);
  Impact impact;
  // It is looked down upon then, and the arrow lies across the view.
  impact.impulses = {{.point = {-1, -1, 0},
                      .direction = {0.64, 0.77, 0},
                      .magnitude = 1,
                      .normal = {-0.64, -0.77, 0}}};
  record.outcome.scene.impacts = {impact};
  const double one = red(collision_picture_of(record, target, kSmall));
  EXPECT_GT(one, 0.002);
  impact.impulses.push_back(
      {.point = {1, 0, 0}, .direction = {-1, 0, 0}, .magnitude = 1, .normal = {1, 0, 0}});
  record.outcome.scene.impacts = {impact};
  EXPECT_GT(red(collision_picture_of(record, target, kSmall)), one);
}

}  // namespace
}  // namespace fracbench
