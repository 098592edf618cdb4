#include "metrics/fracture_normals.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;

TEST(FractureNormals, of_one_cut_are_those_of_its_plane) {
  Random random(1);
  for (int round = 0; round < 20; ++round) {
    const Vec3 n = random.unit_vector();
    const std::vector<Impact> impacts{impact(random.unit_vector())};
    const Vec3 d = impacts[0].impulses[0].direction;
    const Fragments fragments = cut_all(box(), Vec3::Constant(0.5), std::vector<Vec3>{n});
    const Measurement m = FractureNormals().measure(cell(box(), fragments, impacts));
    EXPECT_NEAR(value(m, "normal_along"), std::abs(n.dot(d)), 1e-12);
    EXPECT_NEAR(value(m, "normal_across"), n.cross(d).norm(), 1e-12);
    EXPECT_NEAR(value(m, "fabric_1"), 1, 1e-12);
    EXPECT_NEAR(value(m, "fabric_2"), 0, 1e-12);
    EXPECT_NEAR(value(m, "fabric_3"), 0, 1e-12);
  }
}

TEST(FractureNormals, of_three_orthogonal_cuts_have_an_isotropic_fabric) {
  const std::vector<Vec3> normals{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Fragments fragments = cut_all(box(), Vec3::Constant(0.5), normals);
  const Vec3 d = Vec3(1, 2, 2) / 3;
  const std::vector<Impact> impacts{impact(d)};
  const Measurement m = FractureNormals().measure(cell(box(), fragments, impacts));
  for (const char* name : {"fabric_1", "fabric_2", "fabric_3"}) {
    EXPECT_NEAR(value(m, name), 1.0 / 3, 1e-14);
  }
  EXPECT_NEAR(value(m, "normal_along"), (1 + 2 + 2) / 9.0, 1e-14);
  EXPECT_NEAR(value(m, "normal_across"), (std::sqrt(8) + 2 * std::sqrt(5)) / 9.0, 1e-14);
  EXPECT_NEAR(value(m, "fracture_area"), 3, 1e-13);
}

TEST(FractureNormals, are_weighted_by_area) {
  // Planes x = 1/2 (area 1) and, in one half only, y = 1/2 (area 1/2).
  const auto [left, right] = cut(whole(box()), Vec3::Constant(0.5), {1, 0, 0}, 0);
  const auto [near, far] = cut(right, Vec3::Constant(0.5), {0, 1, 0}, 1);
  const std::vector<Impact> impacts{impact({1, 0, 0})};
  const Measurement m = FractureNormals().measure(cell(box(), {left, near, far}, impacts));
  EXPECT_NEAR(value(m, "normal_along"), 2.0 / 3, 1e-14);
  EXPECT_NEAR(value(m, "normal_across"), 1.0 / 3, 1e-14);
  EXPECT_NEAR(value(m, "fabric_1"), 2.0 / 3, 1e-14);
  EXPECT_NEAR(value(m, "fabric_2"), 1.0 / 3, 1e-14);
}

TEST(FractureNormals, of_isotropic_surfaces_approach_the_stated_values) {
  Random random(2);
  Fragment soup;
  for (int i = 0; i < 40000; ++i) {
    const Vec3 n = random.unit_vector();
    const Vec3 u = n.unitOrthogonal();
    const auto first = static_cast<std::int32_t>(soup.mesh.vertices.size());
    soup.mesh.vertices.insert(soup.mesh.vertices.end(), {Vec3::Zero(), u, n.cross(u)});
    soup.mesh.faces.push_back({first, first + 1, first + 2});
    soup.faces.push_back({.interface = 0});
  }
  const std::vector<Impact> impacts{impact({0, 0, 1})};
  const Measurement m = FractureNormals().measure(cell(box(), {soup}, impacts));
  EXPECT_NEAR(value(m, "normal_along"), 0.5, 0.005);
  EXPECT_NEAR(value(m, "normal_across"), M_PI / 4, 0.005);
  EXPECT_NEAR(value(m, "fabric_1"), 1.0 / 3, 0.01);
}

TEST(FractureNormals, look_at_the_strongest_impulse_of_the_first_impact) {
  const Fragments fragments = cut_all(box(), Vec3::Constant(0.5), std::vector<Vec3>{{1, 0, 0}});
  std::vector<Impact> impacts{impact({1, 0, 0}), impact({0, 1, 0})};
  impacts[0].impulses.push_back(impact({0, 0, 1}).impulses[0]);
  EXPECT_EQ(value(FractureNormals().measure(cell(box(), fragments, impacts)), "normal_along"), 1);
}

TEST(FractureNormals, leave_out_what_does_not_exist) {
  EXPECT_TRUE(FractureNormals().measure(cell(box(), {whole(box())})).values.empty());
  const Fragments fragments = cut_all(box(), Vec3::Constant(0.5), std::vector<Vec3>{{1, 0, 0}});
  const Measurement m = FractureNormals().measure(cell(box(), fragments));
  EXPECT_FALSE(has(m, "normal_along"));
  EXPECT_TRUE(has(m, "fabric_1"));
}

}  // namespace
}  // namespace fracbench
