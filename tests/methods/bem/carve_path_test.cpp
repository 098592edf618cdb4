#include "methods/bem/carve_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "methods/bem/validation/crack_meshes.h"
#include "scenarios/shapes.h"

namespace fracbench::bem {
namespace {

std::set<std::pair<std::int32_t, std::int32_t>> edges_of(const TriangleMesh& mesh) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const Face& f : mesh.faces) {
    for (int k = 0; k < 3; ++k) edges.emplace(f[k], f[(k + 1) % 3]);
  }
  return edges;
}

void expect_path(const CarvedSurface& surface, std::size_t curve, bool closed) {
  const auto edges = edges_of(surface.mesh());
  const std::vector<std::int32_t>& path = surface.path(curve);
  for (std::size_t i = 0; i + (closed ? 0 : 1) < path.size(); ++i) {
    EXPECT_TRUE(edges.contains({path[i], path[(i + 1) % path.size()]}));
  }
  EXPECT_EQ(std::set(path.begin(), path.end()).size(), path.size());
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a}));
}

double least_height(const TriangleMesh& mesh) {
  double least = HUGE_VAL;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      longest = std::max(longest, (mesh.corner(f, k) - mesh.corner(f, (k + 1) % 3)).norm());
    }
    least = std::min(least, area_vector2(mesh, f).norm() / longest);
  }
  return least;
}

std::vector<double> even(double low, double high, int count) {
  std::vector<double> points{low};
  for (const double x : graded(low, high, count, 1)) points.push_back(x);
  return points;
}

TEST(CarvedSurface, DrawsALineOverTheSideOfABoxAndKeepsTheBox) {
  const std::vector<double> grid = even(-1, 1, 10);
  CarvedSurface surface(grid_box(grid, grid, grid));
  SurfaceCurve curve;  // slanted, a little outside of the top, ends within faces
  for (int i = 0; i <= 6; ++i) {
    curve.points.emplace_back(-0.57 + 0.19 * i, -0.31 + 0.1 * i, 1.02);
    curve.walls.emplace_back(0, 0, 1);
  }
  const auto number = surface.carve(curve);
  ASSERT_TRUE(number);
  expect_path(surface, *number, false);
  EXPECT_NEAR(volume(surface.mesh()), 8, 1e-9);
  EXPECT_GT(least_height(surface.mesh()), 0.02);
  const std::vector<std::int32_t>& path = surface.path(*number);
  EXPECT_LT((surface.mesh().vertices[path.front()] - Vec3(-0.57, -0.31, 1)).norm(), 0.06);
  EXPECT_LT((surface.mesh().vertices[path.back()] - Vec3(0.57, 0.29, 1)).norm(), 0.06);
  for (const std::int32_t v : path) {
    const Vec3& p = surface.mesh().vertices[v];
    EXPECT_NEAR(p.z(), 1, 1e-12);
    EXPECT_LT(std::abs((p - Vec3(0, -0.01, 1)).dot(Vec3(-0.1, 0.19, 0).normalized())), 0.06);
  }
}

TEST(CarvedSurface, GoesOverSharpEdgesWithoutRoundingThem) {
  const std::vector<double> grid = even(-1, 1, 8);
  CarvedSurface surface(grid_box(grid, grid, grid));
  SurfaceCurve curve;  // up one side, over the top, down the other, in the plane y = 0.03 x + 0.1
  const auto add = [&](double x, double z) {
    curve.points.emplace_back(x, 0.03 * x + 0.1, z);
    curve.walls.emplace_back(Vec3(x, 0.03 * x, z).normalized());
  };
  for (const double z : {0.3, 0.6, 0.9}) add(1.01, z);
  for (const double x : {0.9, 0.4, -0.1, -0.6, -0.9}) add(x, 1.01);
  for (const double z : {0.9, 0.5, 0.2}) add(-1.01, z);
  const auto number = surface.carve(curve);
  ASSERT_TRUE(number);
  expect_path(surface, *number, false);
  EXPECT_NEAR(volume(surface.mesh()), 8, 1e-9);
}

TEST(CarvedSurface, ClosesARingAroundABody) {
  const std::vector<double> grid = even(-1, 1, 8);
  CarvedSurface surface(grid_box(grid, grid, grid));
  SurfaceCurve ring{.points = {}, .walls = {}, .closed = true};
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * std::numbers::pi * i / 24 + 0.1;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    ring.points.push_back(out * 1.0 / std::max(std::abs(out.x()), std::abs(out.y())) +
                          Vec3(0, 0, 0.13));
    ring.walls.push_back(out);
  }
  const auto number = surface.carve(ring);
  ASSERT_TRUE(number);
  expect_path(surface, *number, true);
  EXPECT_NEAR(volume(surface.mesh()), 8, 1e-9);
}

TEST(CarvedSurface, LetsCurvesCross) {
  const std::vector<double> grid = even(-1, 1, 10);
  CarvedSurface surface(grid_box(grid, grid, grid));
  for (const double turn : {0.3, 1.7}) {
    SurfaceCurve curve;
    for (int i = -4; i <= 4; ++i) {
      curve.points.emplace_back(0.15 * i * std::cos(turn), 0.15 * i * std::sin(turn), 1);
      curve.walls.emplace_back(0, 0, 1);
    }
    ASSERT_TRUE(surface.carve(curve));
  }
  expect_path(surface, 0, false);
  expect_path(surface, 1, false);
  int shared = 0;
  for (const std::int32_t v : surface.path(0)) {
    shared += static_cast<int>(std::ranges::count(surface.path(1), v));
  }
  EXPECT_GE(shared, 1);
}

TEST(CarvedSurface, RefusesWhatItCannotFollow) {
  const std::vector<double> grid = even(-1, 1, 4);
  CarvedSurface surface(grid_box(grid, grid, grid));
  // The wall stands along the curve: it cuts nowhere.
  EXPECT_FALSE(surface.carve({.points = {{-1, 0, 1}, {1, 0, 1}}, .walls = {{1, 0, 0}, {1, 0, 0}}}));
  // Within one face.
  EXPECT_FALSE(
      surface.carve({.points = {{0.1, 0.1, 1}, {0.12, 0.11, 1}}, .walls = {{0, 0, 1}, {0, 0, 1}}}));
}

}  // namespace
}  // namespace fracbench::bem
