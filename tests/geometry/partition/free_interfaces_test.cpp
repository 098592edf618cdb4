#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "core/sum.h"
#include "geometry/partition/arrangement.h"
#include "tests/geometry/partition/label_volumes.h"
#include "tests/geometry/test_meshes.h"

// Interfaces that come from no lattice.
namespace fracbench {
namespace {

using namespace partition;

TEST(FreeInterfaces, MeetTheBodyWhereThoseOfALatticeDo) {
  const TriangleMesh body = test_meshes::torus(24, 12);
  Random random(3);
  const auto labels = test_labels::voronoi(test_labels::grid_around(body, 12), 7, random);
  const LabelLattice lattice = make_lattice(body, labels, 1);
  const InterfaceMesh interfaces = extract_interfaces(lattice, {});
  const Crossings by_grid = find_crossings(body, interfaces, lattice.region, 1);
  const Crossings by_tree = find_crossings(body, interfaces.mesh, 2);
  ASSERT_GT(by_grid.segments.size(), 100u);
  ASSERT_EQ(by_tree.crossings.size(), by_grid.crossings.size());
  for (std::size_t n = 0; n < by_grid.crossings.size(); ++n) {
    EXPECT_EQ(by_tree.crossings[n].position, by_grid.crossings[n].position);
  }
  ASSERT_EQ(by_tree.segments.size(), by_grid.segments.size());
  for (std::size_t n = 0; n < by_grid.segments.size(); ++n) {
    const auto key = [](const CutSegment& s) {
      return std::tuple(s.body_face, s.interface_face, s.from, s.to);
    };
    EXPECT_EQ(key(by_tree.segments[n]), key(by_grid.segments[n]));
  }
}

// Three half planes that meet in a line, which leaves the cube through two of its sides.
TEST(FreeInterfaces, OfThreeHalfPlanesDivideACubeIntoThreeSectors) {
  const TriangleMesh cube = test_meshes::cube(2);
  InterfaceComplex sheets;
  sheets.mesh.vertices = {{0.01, 0.02, -2}, {0.03, -0.01, 2}};
  const std::array<Vec3, 3> away = {Vec3(5, 0.3, 0), Vec3(-2.3, 4, 0), Vec3(-2.1, -4.2, 0)};
  for (int k = 0; k < 3; ++k) {
    const auto first = static_cast<std::int32_t>(sheets.mesh.vertices.size());
    sheets.mesh.vertices.push_back(away[k] + Vec3(0, 0, -2.1));
    sheets.mesh.vertices.push_back(away[k] + Vec3(0.02, 0.03, 2.2));
    // The normal of (axis bottom, axis top, away) points counter-clockwise about z.
    for (const Face& face : {Face{0, 1, first + 1}, Face{0, first + 1, first}}) {
      sheets.mesh.faces.push_back(face);
      sheets.sides.push_back({1 + (k + 2) % 3, 1 + k});
    }
  }
  const auto nowhere = [](const Vec3&) -> std::int32_t { return -7; };
  const Arrangement cut = arrange(cube, sheets, find_crossings(cube, sheets.mesh, 1), nowhere, 1);
  // Volume of each region by the divergence theorem.
  std::array<Sum, 4> volume;
  const auto add = [&](const Face& f, std::int32_t region, double sign) {
    ASSERT_GE(region, 1);
    ASSERT_LE(region, 3);
    const auto& v = cut.vertices;
    volume[region] += sign * v[f[0]].dot(v[f[1]].cross(v[f[2]])) / 6;
  };
  for (const auto& part : cut.body) add(part.corners, part.region, 1);
  for (const auto& part : cut.interfaces) {
    add(part.corners, part.regions[0], 1);
    add(part.corners, part.regions[1], -1);
  }
  EXPECT_NEAR(volume[1].value() + volume[2].value() + volume[3].value(), 8, 1e-12);
  // About the shares of a square between rays at 3, 120 and 243 degrees.
  EXPECT_NEAR(volume[1].value(), 8 * 0.3, 8 * 0.06);
  EXPECT_NEAR(volume[2].value(), 8 * 0.35, 8 * 0.1);
  EXPECT_NEAR(volume[3].value(), 8 * 0.3, 8 * 0.06);
}

}  // namespace
}  // namespace fracbench
