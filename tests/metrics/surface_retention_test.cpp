#include "metrics/surface_retention.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;

const std::vector<Vec3> normals{{1, 0.3, 0.2}, {-0.4, 1, 0.1}, {0, 0.2, 1}};

Measurement measured(const TriangleMesh& body, const Fragments& fragments) {
  return SurfaceRetention().measure(cell(body, fragments));
}

TEST(SurfaceRetention, of_clean_cuts_is_one_and_nothing_is_off) {
  const TriangleMesh body = box({-3, 2, 7}, {-1, 2.5, 8});
  const Fragments fragments = cut_all(body, {-2, 2.2, 7.5}, normals);
  const Measurement m = measured(body, fragments);
  EXPECT_NEAR(value(m, "surface_retention"), 1, 1e-13);
  EXPECT_LT(value(m, "surface_distance"), 1e-14);
}

TEST(SurfaceRetention, misses_what_is_not_there) {
  const TriangleMesh body = box();
  const auto [left, right] = cut(whole(body), {0.25, 0, 0}, {1, 0, 0}, 0);
  // A face of the cube and a quarter of four others; the far corners are 3/4 away.
  const Measurement m = measured(body, {left});
  EXPECT_NEAR(value(m, "surface_retention"), 2.0 / 6, 1e-14);
  EXPECT_NEAR(value(m, "surface_distance"), 0.75, 1e-14);
}

TEST(SurfaceRetention, does_not_believe_a_tag_that_is_not_true) {
  const TriangleMesh body = box();
  Fragments fragments = cut_all(body, Vec3::Constant(0.5), std::vector<Vec3>{{1, 0, 0}});
  // The surface is there, though its faces name others that they do not lie on.
  for (Fragment& fragment : fragments) {
    for (FragmentFace& face : fragment.faces) {
      if (!face.is_fracture()) face.original_face = (face.original_face + 2) % 12;
    }
  }
  EXPECT_NEAR(value(measured(body, fragments), "surface_retention"), 1, 1e-14);
  // Fracture surface that claims to be original.
  fragments = cut_all(body, Vec3::Constant(0.5), std::vector<Vec3>{{1, 0, 0}});
  for (Fragment& fragment : fragments) {
    for (FragmentFace& face : fragment.faces) face.original_face = std::max(0, face.original_face);
  }
  const Measurement m = measured(body, fragments);
  EXPECT_NEAR(value(m, "surface_retention"), 1, 1e-14);
  EXPECT_NEAR(value(m, "surface_distance"), 0.5, 1e-14);
  // A number that is no face of the body: the place counts.
  for (Fragment& fragment : fragments) {
    for (FragmentFace& face : fragment.faces) face.original_face = 12;
  }
  EXPECT_NEAR(value(measured(body, fragments), "surface_retention"), 1, 1e-14);
}

TEST(SurfaceRetention, finds_the_surface_where_its_flat_parts_are_divided_anew) {
  const TriangleMesh body = box();
  // Both halves of each side of the box joined along the other diagonal.
  Fragment turned = whole(body);
  for (std::size_t f = 0; f + 1 < turned.mesh.faces.size(); f += 2) {
    const Face a = turned.mesh.faces[f];
    const Face b = turned.mesh.faces[f + 1];
    const auto apex = [](const Face& of, const Face& other) {
      for (int k = 0; k < 3; ++k) {
        if (std::ranges::find(other, of[k]) == other.end()) return k;
      }
      return -1;
    };
    const int k = apex(a, b);
    const int l = apex(b, a);
    if (k < 0 || l < 0) continue;
    turned.mesh.faces[f] = {a[k], a[(k + 1) % 3], b[l]};
    turned.mesh.faces[f + 1] = {a[k], b[l], a[(k + 2) % 3]};
  }
  ASSERT_NE(turned.mesh.faces, body.faces);
  EXPECT_NEAR(value(measured(body, {turned}), "surface_retention"), 1, 1e-14);
}

TEST(SurfaceRetention, a_surface_turned_inside_out_is_not_retained) {
  const TriangleMesh body = box();
  Fragment flipped = whole(body);
  for (Face& face : flipped.mesh.faces) std::swap(face[0], face[1]);
  EXPECT_EQ(value(measured(body, {flipped}), "surface_retention"), 0);
}

TEST(SurfaceRetention, tells_how_far_a_moved_surface_is_off) {
  const TriangleMesh body = box();
  for (const double shift : {1e-8, 1e-3, 0.2}) {
    Fragment moved = whole(body);
    for (Vec3& v : moved.mesh.vertices)
      v = Vec3::Constant(0.5) + (1 + 2 * shift) * (v - Vec3::Constant(0.5));
    const Measurement m = measured(body, {moved});
    EXPECT_NEAR(value(m, "surface_distance"), shift * std::sqrt(3), 1e-14);
    EXPECT_EQ(value(m, "surface_retention") > 0.5, shift < kRetentionTolerance);
  }
}

TEST(SurfaceRetention, is_the_same_for_any_number_of_threads) {
  const TriangleMesh body = box();
  const Fragments fragments = cut_all(body, Vec3::Constant(0.45), normals);
  CellResult one = cell(body, fragments);
  CellResult four = cell(body, fragments);
  four.threads = 4;
  const Measurement a = SurfaceRetention().measure(one);
  const Measurement b = SurfaceRetention().measure(four);
  EXPECT_EQ(value(a, "surface_retention"), value(b, "surface_retention"));
  EXPECT_EQ(value(a, "surface_distance"), value(b, "surface_distance"));
}

TEST(SurfaceRetention, of_nothing_is_zero_and_has_no_distance) {
  const Measurement m = measured(box(), {});
  EXPECT_EQ(value(m, "surface_retention"), 0);
  EXPECT_FALSE(has(m, "surface_distance"));
}

}  // namespace
}  // namespace fracbench
