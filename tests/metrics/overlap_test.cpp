#include "geometry/overlap.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;

std::vector<Overlap> overlaps(const std::vector<TriangleMesh>& meshes) {
  return find_overlaps(
      std::vector<std::reference_wrapper<const TriangleMesh>>(meshes.begin(), meshes.end()));
}

TriangleMesh turned(TriangleMesh mesh, const Mat3& turn) {
  for (Vec3& v : mesh.vertices) v = turn * v;
  return mesh;
}

TEST(Overlaps, are_none_between_pieces_of_one_body) {
  Random random(1);
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec3> normals;
    for (int i = 0; i < 5; ++i) normals.push_back(random.unit_vector());
    std::vector<TriangleMesh> meshes;
    const Vec3 point(0.4, 0.5, 0.6);
    for (const Fragment& fragment : cut_all(box(), point, normals)) {
      if (!fragment.mesh.empty()) meshes.push_back(fragment.mesh);
    }
    EXPECT_TRUE(overlaps(meshes).empty()) << round;
  }
  std::vector<TriangleMesh> rough;
  for (const Fragment& fragment : corrugated_cube(10, 50)) rough.push_back(fragment.mesh);
  EXPECT_TRUE(overlaps(rough).empty());
}

TEST(Overlaps, are_found_however_two_boxes_interpenetrate) {
  Random random(2);
  const Vec3 o = Vec3::Zero();
  struct Case {
    const char* name;
    TriangleMesh a, b;
  };
  const std::vector<Case> cases{
      {"corner in the other", box(), box({0.9, 0.9, 0.9}, {2, 2, 2})},
      {"one in the other", box(), box({0.2, 0.2, 0.2}, {0.3, 0.3, 0.3})},
      {"the same twice", box(), box()},
      {"crossed bars, no vertex in the other", box({-5, 0, 0}, {5, 1, 1}),
       box({0, -5, 0.1}, {1, 5, 0.9})},
      {"a needle through a face", box(), box({0.5, 0.5, -1}, {0.501, 0.501, 2})},
      {"shared sides, one longer", box(), box(o, {2, 1, 1})},
      {"shared sides, shifted", box(), box({0.5, 0, 0}, {1.5, 1, 1})},
      {"a sliver of 1e-5", box(), box({1 - 1e-5, 0, 0}, {2, 1, 1})},
  };
  for (const Case& c : cases) {
    for (int round = 0; round < 4; ++round) {
      const Mat3 turn =
          round == 0 ? Mat3::Identity().eval()
                     : Eigen::AngleAxisd(random.uniform(0, 6), random.unit_vector()).matrix();
      const auto found =
          overlaps({turned(c.a, turn), box({9, 9, 9}, {10, 10, 10}), turned(c.b, turn)});
      ASSERT_EQ(found.size(), 1u) << c.name << " " << round;
      EXPECT_EQ(found[0].first, 0);
      EXPECT_EQ(found[0].second, 2);
      EXPECT_GT(found[0].depth, 1e-6) << c.name;
    }
  }
}

TEST(Overlaps, touching_and_rounding_are_allowed) {
  EXPECT_TRUE(overlaps({box(), box({1, 0, 0}, {2, 1, 1})}).empty());
  EXPECT_TRUE(overlaps({box(), box({1, 0.3, 0.2}, {2, 2, 0.7})}).empty());  // partly shared side
  EXPECT_TRUE(overlaps({box(), box({1, 1, 1}, {2, 2, 2})}).empty());        // a corner
  EXPECT_TRUE(overlaps({box(), box({1 - 1e-9, 0, 0}, {2, 1, 1})}).empty());
  EXPECT_TRUE(overlaps({box(), box({1.5, 0, 0}, {2, 1, 1})}).empty());
  EXPECT_TRUE(overlaps({box()}).empty());
  EXPECT_TRUE(overlaps({}).empty());
}

TEST(Overlaps, are_the_same_for_any_number_of_threads) {
  std::vector<TriangleMesh> meshes;
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const Vec3 low(random.uniform(), random.uniform(), random.uniform());
    meshes.push_back(box(low, low + Vec3::Constant(0.3)));
  }
  const std::vector<std::reference_wrapper<const TriangleMesh>> solids(meshes.begin(),
                                                                       meshes.end());
  const auto one = find_overlaps(solids, {.threads = 1});
  const auto two = find_overlaps(solids, {.threads = 2});
  EXPECT_GT(one.size(), 5u);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].first, two[k].first);
    EXPECT_EQ(one[k].second, two[k].second);
    EXPECT_EQ(one[k].place, two[k].place);
    // Boxes of one size and orientation overlap exactly when their corners are near.
    const Vec3 apart = meshes[one[k].first].vertices[0] - meshes[one[k].second].vertices[0];
    EXPECT_LT(apart.cwiseAbs().maxCoeff(), 0.3);
  }
}

}  // namespace
}  // namespace fracbench
