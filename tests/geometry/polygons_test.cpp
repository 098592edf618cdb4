#include "geometry/formats/polygons.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "core/random.h"

namespace fracbench::formats {
namespace {

Vec3 area2(const std::vector<Vec3>& corners, const Face& t) {
  return (corners[t[1]] - corners[t[0]]).cross(corners[t[2]] - corners[t[0]]);
}

/// Star-shaped polygons of many corners, in a random plane.
std::vector<Vec3> random_star(Random& random, int corners, double spikes) {
  const Vec3 u = random.unit_vector();
  const Vec3 v = u.cross(random.unit_vector()).normalized();
  std::vector<Vec3> result;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double r = 1 - spikes * random.uniform();
    result.push_back(r * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return result;
}

/// Every side of the polygon is a side of one triangle, every cut one of two that run opposite.
void expect_closed_against(std::size_t corners, const std::vector<Face>& triangles) {
  std::multiset<std::pair<int, int>> sides;
  for (const Face& t : triangles) {
    for (int k = 0; k < 3; ++k) sides.emplace(t[k], t[(k + 1) % 3]);
  }
  for (std::size_t i = 0; i < corners; ++i) {
    const std::pair<int, int> side(i, (i + 1) % corners);
    EXPECT_EQ(sides.count(side), 1u);
    sides.erase(side);
  }
  for (const auto& [a, b] : sides) EXPECT_EQ(sides.count({b, a}), sides.count({a, b}));
}

TEST(TriangulatedPolygon, FillsStarsExactlyOnce) {
  Random random(11);
  for (const int corners : {4, 5, 8, 30, 100, 400}) {
    for (const double spikes : {0.0, 0.5, 0.95}) {
      const std::vector<Vec3> star = random_star(random, corners, spikes);
      const std::vector<Face> triangles = triangulated_polygon(star);
      ASSERT_EQ(triangles.size(), star.size() - 2);
      expect_closed_against(star.size(), triangles);
      Vec3 whole = Vec3::Zero();
      for (int i = 0; i < corners; ++i) whole += star[i].cross(star[(i + 1) % corners]);
      double sum = 0;
      for (const Face& t : triangles) {
        EXPECT_GT(area2(star, t).dot(whole), 0);
        sum += area2(star, t).norm();
      }
      EXPECT_NEAR(sum, whole.norm(), 1e-12);
    }
  }
}

TEST(TriangulatedPolygon, KeepsCornersThatAreOnALineWithoutFlatTriangles) {
  // A square with corners along its sides.
  std::vector<Vec3> square;
  for (int side = 0; side < 4; ++side) {
    const Vec3 from(side == 1 || side == 2, side >= 2, 0);
    const Vec3 to(side == 0 || side == 1, side == 1 || side == 2, 0);
    for (int i = 0; i < 4; ++i) square.push_back(from + i / 4.0 * (to - from));
  }
  const std::vector<Face> triangles = triangulated_polygon(square);
  expect_closed_against(square.size(), triangles);
  for (const Face& t : triangles) EXPECT_GT(area2(square, t).z(), 0);
}

TEST(TriangulatedPolygon, TakesTheShorterCutOfAQuadrilateral) {
  const std::vector<Vec3> kite = {Vec3(0, 0, 0), Vec3(1, -1, 0), Vec3(9, 0, 0), Vec3(1, 1, 0)};
  for (const Face& t : triangulated_polygon(kite)) {
    EXPECT_EQ(std::count(t.begin(), t.end(), 1) + std::count(t.begin(), t.end(), 3), 2);
  }
}

TEST(TriangulatedPolygon, GivesSomethingForPolygonsThatAreNotSimple) {
  const std::vector<Vec3> bow_tie = {Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  EXPECT_EQ(triangulated_polygon(bow_tie).size(), 2u);
  const std::vector<Vec3> line = {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3(3, 3, 3)};
  EXPECT_EQ(triangulated_polygon(line).size(), 2u);
  EXPECT_EQ(triangulated_polygon(std::vector<Vec3>(7, Vec3(1, 2, 3))).size(), 5u);
  EXPECT_TRUE(triangulated_polygon({}).empty());
}

}  // namespace
}  // namespace fracbench::formats
