#include "geometry/isosurface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/random.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "geometry/signed_distance_grid.h"
#include "geometry/surface_distance.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

VoxelGrid<float> sampled(VoxelGrid<float> grid, const std::function<double(const Vec3&)>& field) {
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        grid.at(i, j, k) = static_cast<float>(field(grid.position(i, j, k)));
      }
    }
  }
  return grid;
}

/// Few distinct values, so that ambiguous faces, saddles on the level and samples on the level are
/// all common.
VoxelGrid<float> noise(int size, int distinct, std::uint64_t seed) {
  Random random(seed);
  VoxelGrid<float> grid({size, size + 1, size - 1}, Vec3(1, 2, 3), 0.25);
  for (float& value : grid.values) {
    value = static_cast<float>(random.below(distinct)) - static_cast<float>(distinct - 1) / 2;
  }
  return grid;
}

void expect_closed(const TriangleMesh& mesh, const std::string& name) {
  const MeshReport report = check_mesh(mesh, {.self_intersections = false});
  EXPECT_TRUE(report.closed && report.manifold) << name << ": " << report.describe();
  EXPECT_FALSE(report.degenerate_faces) << name;
  EXPECT_GT(report.volume, 0) << name;
}

TEST(Isosurface, IsClosedAndManifoldWhateverTheField) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    for (const int distinct : {2, 3, 4, 1000}) {
      expect_closed(isosurface(noise(9, distinct, seed)),
                    "noise of " + std::to_string(distinct) + " values");
    }
  }
  VoxelGrid<float> chessboard({8, 8, 8}, Vec3::Zero(), 1);
  for (int k = 0; k < 8; ++k) {
    for (int j = 0; j < 8; ++j) {
      for (int i = 0; i < 8; ++i) chessboard.at(i, j, k) = (i + j + k) % 2 == 0 ? 1.0f : -1.0f;
    }
  }
  expect_closed(isosurface(chessboard), "chessboard");
}

TEST(Isosurface, AllKindsOfCellsAreClosed) {
  // All 256 signs of the corners of one cell, with values that join ambiguous faces and that do
  // not.
  for (const float inside : {1.0f, 5.0f, 0.2f}) {
    for (int signs = 1; signs < 256; ++signs) {
      VoxelGrid<float> cell({2, 2, 2}, Vec3::Zero(), 1);
      for (int c = 0; c < 8; ++c) cell.values[c] = signs >> c & 1 ? inside : -1.0f;
      expect_closed(isosurface(cell), "cell " + std::to_string(signs));
    }
  }
}

TEST(Isosurface, SamplesAboveTheLevelAreInsideAndTheOthersOutside) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const VoxelGrid<float> field = noise(8, 1000, seed);
    const SurfaceDistance surface(isosurface(field, 20));
    for (int k = 0; k < field.size[2]; ++k) {
      for (int j = 0; j < field.size[1]; ++j) {
        for (int i = 0; i < field.size[0]; ++i) {
          EXPECT_EQ(surface.inside(field.position(i, j, k)), field.at(i, j, k) > 20);
        }
      }
    }
  }
}

TEST(Isosurface, VerticesLieWhereTheFieldCrossesTheLevel) {
  // A linear field is met exactly.
  const Vec3 slope(0.3, -0.5, 0.8);
  const VoxelGrid<float> field =
      sampled(unit_grid<float>(12), [&](const Vec3& p) { return slope.dot(p); });
  const TriangleMesh mesh = isosurface(field, 0.05f);
  int crossings = 0;
  for (const Vec3& v : mesh.vertices) {
    if (v.cwiseAbs().maxCoeff() > 1 - 1.0 / 12 - 1e-9) continue;  // the caps at the grid's edge
    EXPECT_NEAR(slope.dot(v), 0.05, 2e-4);
    ++crossings;
  }
  EXPECT_GT(crossings, 100);
}

TEST(Isosurface, TheSphereConvergesWithTheSecondOrder) {
  const double radius = 0.73, exact = 4 * std::numbers::pi / 3 * std::pow(radius, 3);
  const auto mesh = [&](int r) {
    return isosurface(
        sampled(unit_grid<float>(r), [&](const Vec3& p) { return radius - p.norm(); }));
  };
  const auto error = [&](int r) { return std::abs(volume(mesh(r)) / exact - 1); };
  EXPECT_NEAR(std::log2(error(16) / error(64)) / 2, 2, 0.2);
  EXPECT_LT(error(64), 1.5e-3);
  EXPECT_NEAR(area(mesh(64)), 4 * std::numbers::pi * radius * radius, 0.01);
  EXPECT_TRUE(check_mesh(mesh(32)).is_solid());
}

TEST(Isosurface, SmoothFieldsGiveSolids) {
  for (const auto& [name, solid] : test_meshes::solids()) {
    if (name == "plate") continue;  // thinner than any voxel
    const BoundingBox box = bounding_box(solid);
    const double spacing = 1.2 * box.longest_side() / 24;
    const VoxelGrid<float> grid({24, 24, 24}, box.center() - 11.5 * Vec3::Constant(spacing),
                                spacing);
    const TriangleMesh mesh = isosurface(signed_distance_grid(solid, grid));
    const MeshReport report = check_mesh(mesh);
    EXPECT_TRUE(report.is_solid()) << name << ": " << report.describe();
  }
}

TEST(Isosurface, TheGridsEdgeClosesTheSurface) {
  // Everything is inside: what remains is the grid's box.
  const VoxelGrid<float> full({5, 6, 7}, Vec3(-1, 0, 1), 0.5, 1.0f);
  const TriangleMesh mesh = isosurface(full);
  EXPECT_TRUE(check_mesh(mesh).is_solid()) << check_mesh(mesh).describe();
  EXPECT_NEAR(volume(mesh), 2 * 2.5 * 3, 0.02);
  // A ball that is cut by the grid's edge.
  const TriangleMesh cut = isosurface(sampled(
      unit_grid<float>(20), [](const Vec3& p) { return 0.6 - (p - Vec3(0.9, 0, 0)).norm(); }));
  EXPECT_TRUE(check_mesh(cut).is_solid()) << check_mesh(cut).describe();
  EXPECT_LE(bounding_box(cut).high.x(), 0.96);
}

TEST(Isosurface, NothingAboveTheLevelIsAnEmptyMesh) {
  EXPECT_TRUE(isosurface(unit_grid<float>(4, -1.0f)).empty());
  EXPECT_TRUE(isosurface(unit_grid<float>(4, 0.0f)).empty());
  EXPECT_TRUE(isosurface(VoxelGrid<float>({0, 0, 0}, Vec3::Zero(), 1)).empty());
}

TEST(Isosurface, BrokenValuesDoNotBreakTheSurface) {
  VoxelGrid<float> field = noise(7, 4, 3);
  field.values[100] = std::numeric_limits<float>::quiet_NaN();
  field.values[150] = std::numeric_limits<float>::infinity();
  field.values[200] = -std::numeric_limits<float>::infinity();
  const TriangleMesh mesh = isosurface(field);
  const MeshReport report = check_mesh(mesh, {.self_intersections = false});
  EXPECT_TRUE(report.finite && report.closed && report.manifold) << report.describe();
}

}  // namespace
}  // namespace fracbench
