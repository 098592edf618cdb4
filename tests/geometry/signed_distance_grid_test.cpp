#include "geometry/signed_distance_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/random.h"
#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "geometry/surface_distance.h"
#include "tests/geometry/reference_field.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

/// A grid of uneven sizes around the mesh, placed at random.
VoxelGrid<float> random_grid(const TriangleMesh& mesh, Random& random, int size) {
  const BoundingBox box = bounding_box(mesh);
  const std::array<std::int32_t, 3> sizes{size, size + 3, size - 2};
  const double spacing = 1.4 * box.longest_side() / size;
  const Vec3 shift(random.uniform(), random.uniform(), random.uniform());
  return {sizes, box.center() - 0.7 * Vec3::Constant(box.longest_side()) - spacing * shift,
          spacing};
}

/// Everything that the header promises, at every sample, by brute force.
void expect_exact(const TriangleMesh& mesh, const VoxelGrid<float>& grid, const std::string& name) {
  const BoundingBox box = bounding_box(mesh);
  const double rounding = 1e-13 * (box.longest_side() + box.center().norm());
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const double expected = reference::signed_distance(mesh, grid.position(i, j, k));
        const double got = grid.at(i, j, k);
        // The sign of a sample on the surface is open.
        const double error = std::abs(expected) < rounding
                                 ? std::abs(std::abs(got) - std::abs(expected))
                                 : std::abs(got - expected);
        EXPECT_LE(error, rounding + 6.1e-8 * std::abs(expected))
            << name << " at " << grid.position(i, j, k).transpose() << ": " << got << " for "
            << expected;
      }
    }
  }
}

TEST(SignedDistanceGrid, IsExactAtEverySample) {
  for (const auto& [name, mesh] : test_meshes::solids()) {
    Random random(derive_seed(1, {name}));
    const VoxelGrid<float> grid = signed_distance_grid(mesh, random_grid(mesh, random, 11));
    expect_exact(mesh, grid, name);
  }
}

TEST(SignedDistanceGrid, SamplesInThePlanesOfVerticesEdgesAndFacesAreRight) {
  // Every line of samples runs through vertices, along edges or within faces.
  const std::vector<test_meshes::Named> meshes = {
      {"cube", test_meshes::cube(2)},
      {"hollow cube", test_meshes::hollow_cube()},
      {"steps", test_meshes::joined({test_meshes::box(Vec3(-2, -2, -2), Vec3(0, 0, 0)),
                                     test_meshes::box(Vec3(0.5, -1, -2), Vec3(2, 1, -1))})},
      {"octahedron", test_meshes::sphere(2, 4)},
      {"tetrahedron", test_meshes::tetrahedron()}};
  for (const auto& [name, mesh] : meshes) {
    const VoxelGrid<float> grid =
        signed_distance_grid(mesh, VoxelGrid<float>({13, 13, 13}, Vec3::Constant(-3), 0.5));
    expect_exact(mesh, grid, name);
  }
}

TEST(SignedDistanceGrid, AgreesWithClosedForms) {
  const VoxelGrid<float> empty({30, 31, 32}, Vec3(-2, -2.1, -1.9), 0.13);
  const Vec3 low(-1, -0.7, -1.2), high(0.8, 1, 1.1);
  const VoxelGrid<float> box = signed_distance_grid(test_meshes::box(low, high), empty);
  const VoxelGrid<float> ball = signed_distance_grid(test_meshes::sphere(200, 300, 1.3), empty);
  for (int k = 0; k < empty.size[2]; ++k) {
    for (int j = 0; j < empty.size[1]; ++j) {
      for (int i = 0; i < empty.size[0]; ++i) {
        const Vec3 p = empty.position(i, j, k);
        EXPECT_NEAR(box.at(i, j, k), reference::box_signed_distance(low, high, p), 3e-7);
        // The facets lie within 1.3 (1 - cos(pi / 200) cos(pi / 300)) of the sphere.
        EXPECT_NEAR(ball.at(i, j, k), 1.3 - p.norm(), 2.5e-4);
      }
    }
  }
}

TEST(SignedDistanceGrid, AgreesWithTheQueriesOnePointAtATime) {
  const TriangleMesh mesh = test_meshes::torus(60, 30);
  const SurfaceDistance surface(mesh);
  const VoxelGrid<float> grid = signed_distance_grid(mesh, unit_grid<float>(20));
  for (int k = 0; k < 20; ++k) {
    for (int j = 0; j < 20; ++j) {
      for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(grid.at(i, j, k),
                  static_cast<float>(surface.signed_distance(grid.position(i, j, k))));
      }
    }
  }
}

TEST(SignedDistanceGrid, IsTheSameBytesForAnyNumberOfThreads) {
  for (const auto& [name, mesh] : test_meshes::solids()) {
    Random random(derive_seed(2, {name}));
    const VoxelGrid<float> empty = random_grid(mesh, random, 25);
    const VoxelGrid<float> one = signed_distance_grid(mesh, empty, 1);
    for (const int threads : {2, 3}) {
      const VoxelGrid<float> many = signed_distance_grid(mesh, empty, threads);
      EXPECT_EQ(
          std::memcmp(one.values.data(), many.values.data(), one.values.size() * sizeof(float)), 0)
          << name << " " << threads;
    }
  }
}

TEST(SignedDistanceGrid, TheSquirrelIsExactAtRandomSamples) {
  const auto file = test_meshes::shared_mesh("squirrel.obj");
  if (file.empty()) GTEST_SKIP() << "../shared/meshes/squirrel.obj is not there";
  const TriangleMesh mesh = read_mesh(file);
  const VoxelGrid<float> grid = signed_distance_grid(mesh, unit_grid<float>(40));
  Random random(6);
  for (int n = 0; n < 400; ++n) {
    const auto i = static_cast<int>(random.below(40)), j = static_cast<int>(random.below(40)),
               k = static_cast<int>(random.below(40));
    EXPECT_NEAR(grid.at(i, j, k), reference::signed_distance(mesh, grid.position(i, j, k)), 1e-7);
  }
}

TEST(SignedDistanceGrid, GridsOfOneSampleAndOfNoneAreFine) {
  const TriangleMesh mesh = test_meshes::cube();
  const VoxelGrid<float> one =
      signed_distance_grid(mesh, VoxelGrid<float>({1, 1, 1}, Vec3(0.5, 0.1, 0.2), 1));
  EXPECT_EQ(one.values, std::vector<float>{0.5f});
  EXPECT_TRUE(
      signed_distance_grid(mesh, VoxelGrid<float>({0, 3, 3}, Vec3(0, 0, 0), 1)).values.empty());
  EXPECT_TRUE(
      signed_distance_grid(mesh, VoxelGrid<float>({3, 3, 0}, Vec3(0, 0, 0), 1)).values.empty());
}

TEST(SignedDistanceGrid, AnEmptyMeshIsRefused) {
  EXPECT_THROW(signed_distance_grid({}, unit_grid<float>(4)), InputError);
}

}  // namespace
}  // namespace fracbench
