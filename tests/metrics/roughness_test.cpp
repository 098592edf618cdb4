#include "metrics/roughness.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;

TEST(Roughness, of_planar_cuts_is_zero) {
  Random random(1);
  for (int round = 0; round < 20; ++round) {
    const std::vector<Vec3> normals{random.unit_vector(), random.unit_vector(),
                                    random.unit_vector()};
    // Far from the origin, where a careless sum of moments would lose the plane.
    const TriangleMesh body = box(Vec3::Constant(100), Vec3::Constant(101));
    const Fragments fragments = cut_all(body, Vec3::Constant(100.5), normals);
    const Measurement m = Roughness().measure(cell(body, fragments));
    EXPECT_LT(value(m, "roughness"), 1e-9);
    EXPECT_EQ(value(m, "interface_count"), 7);
  }
}

TEST(Roughness, of_a_saw_tooth_is_the_angle_of_its_flanks) {
  for (const double degrees : {1e-3, 5.0, 20.0, 40.0}) {
    const Measurement m = Roughness().measure(cell(box(), corrugated_cube(8, degrees)));
    EXPECT_NEAR(value(m, "roughness"), degrees, 1e-9 + 1e-9 * degrees);
    EXPECT_EQ(value(m, "interface_count"), 1);
    ASSERT_EQ(series(m, "interface_roughness").size(), 2u);
    EXPECT_NEAR(series(m, "interface_roughness")[1], degrees, 1e-9 + 1e-9 * degrees);
  }
}

TEST(Roughness, does_not_change_when_the_body_is_turned_moved_or_scaled) {
  Random random(3);
  const Fragments still = corrugated_cube(6, 25);
  for (int round = 0; round < 10; ++round) {
    const Mat3 turn = Eigen::AngleAxisd(random.uniform(0, 6), random.unit_vector()).matrix();
    const double scale = random.uniform(0.01, 50);
    const Vec3 shift = 5 * random.unit_vector();
    Fragments moved = still;
    for (Fragment& fragment : moved) {
      for (Vec3& v : fragment.mesh.vertices) v = scale * (turn * v) + shift;
    }
    EXPECT_NEAR(value(Roughness().measure(cell(box(), moved)), "roughness"), 25, 1e-8);
  }
}

TEST(Roughness, is_measured_interface_by_interface) {
  // Two planar cuts at a right angle that carry one number are a fold; with numbers of their own
  // they are planes.
  const auto [left, right] = cut(whole(box()), Vec3::Constant(0.5), {1, 0, 0}, 0);
  const auto [near, far] = cut(right, Vec3::Constant(0.5), {0, 1, 0}, 1);
  EXPECT_LT(value(Roughness().measure(cell(box(), {near})), "roughness"), 1e-9);
  Fragment folded = near;
  for (FragmentFace& face : folded.faces) {
    if (face.is_fracture()) face.interface = 5;
  }
  // Both planes are at 45 degrees to the plane between them, which fits best.
  EXPECT_GT(value(Roughness().measure(cell(box(), {folded})), "roughness"), 30);
}

TEST(Roughness, weights_interfaces_by_their_area) {
  // A flat cut of area 1 and a saw tooth at 60 degrees of area 2, each seen from both sides.
  Fragments fragments = corrugated_cube(20, 60);
  for (const Fragment& fragment :
       cut_all(box({5, 0, 0}, {6, 1, 1}), {5.5, 0.5, 0.5}, std::vector<Vec3>{{1, 0, 0}})) {
    fragments.push_back(fragment);
    for (FragmentFace& face : fragments.back().faces) face.interface += face.is_fracture() ? 9 : 0;
  }
  EXPECT_NEAR(value(Roughness().measure(cell(box(), fragments)), "roughness"), 40, 1e-9);
}

TEST(Roughness, does_not_exist_without_known_interfaces) {
  EXPECT_TRUE(Roughness().measure(cell(box(), {whole(box())})).values.empty());
  Fragments fragments = corrugated_cube(3, 10);
  for (Fragment& fragment : fragments) {
    for (FragmentFace& face : fragment.faces) face.interface = -1;
  }
  EXPECT_TRUE(Roughness().measure(cell(box(), fragments)).values.empty());
}

}  // namespace
}  // namespace fracbench
