#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "geometry/boolean.h"
#include "geometry/measures.h"
#include "tests/geometry/partition/label_volumes.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using namespace test_labels;
using test_meshes::Named;

/// A jar whose wall is thinner than the voxels of a coarse grid.
TriangleMesh thin_jar() {
  return test_meshes::joined(
      {test_meshes::sphere(20, 30, 0.95), test_meshes::flipped(test_meshes::sphere(20, 30, 0.92))});
}

std::vector<Named> bodies() {
  std::vector<Named> result;
  for (const Named& solid : test_meshes::solids()) {
    // The partition works at the scale of its grid; so far away, doubles have no digits for it.
    if (solid.name != "far cube" && solid.name != "linked tori") result.push_back(solid);
  }
  result.push_back({"thin jar", thin_jar()});
  return result;
}

TEST(Partition, OfEveryBodyByEveryKindOfLabelsFillsItExactlyWithSolids) {
  for (const Named& body : bodies()) {
    Random random(7);
    for (const int r : {5, 10}) {
      const Labels grid = grid_around(body.mesh, r);
      const std::vector<std::pair<std::string, Labels>> volumes = {
          {"voronoi", voronoi(grid, 9, random)},
          {"noise", noise(grid, 3, random)},
          {"checkerboard", checkerboard(grid)},
          {"slabs", slabs(grid, 3)},
          {"single voxels", single_voxels(grid)}};
      for (const auto& [name, labels] : volumes) {
        if (r > 5 && name == "single voxels") continue;
        const Partition partition = partition_by_labels(body.mesh, labels);
        EXPECT_EQ(faults(body.mesh, partition, {.disjoint = name == "voronoi"}), "")
            << body.name << ", " << name << ", r = " << r;
        EXPECT_GE(partition.pieces.size(), 1u);
      }
    }
  }
}

TEST(Partition, OfTinyRandomVolumesIsAlwaysValid) {
  const std::vector<Named> bodies = {{"cube", test_meshes::cube(1.9)},
                                     {"sphere", test_meshes::sphere(12, 16, 0.95)},
                                     {"hollow", test_meshes::hollow_cube()},
                                     {"torus", test_meshes::torus(16, 8)}};
  for (int round = 0; round < 28; ++round) {
    Random random(static_cast<std::uint64_t>(round));
    const Named& body = bodies[round % bodies.size()];
    const int r = 4 + static_cast<int>(random.below(5));
    const int count = 1 + static_cast<int>(random.below(6));
    Labels labels = noise(grid_around(body.mesh, r), count, random);
    // Every other volume has holes.
    if (round % 2 == 1) {
      for (std::int32_t& label : labels.values) label = random.below(3) == 0 ? 0 : label;
    }
    labels.values[labels.index(r / 2, r / 2, r / 2)] = 1;
    try {
      const Partition partition =
          partition_by_labels(body.mesh, labels, {.minimum_voxels = round % 3 == 0 ? 0 : 0.5});
      EXPECT_EQ(faults(body.mesh, partition, {.disjoint = round % 4 == 0}), "")
          << body.name << ", round " << round;
    } catch (const InputError&) {
      ADD_FAILURE() << body.name << ", round " << round << ": no label inside";
    }
  }
}

TEST(Partition, ByOneLabelReturnsTheBodyBitForBit) {
  for (const Named& body : bodies()) {
    if (body.name == "two cubes") continue;
    const Labels labels = filled(grid_around(body.mesh, 12), [](int, int, int) { return 5; });
    const Partition partition = partition_by_labels(body.mesh, labels);
    if (body.name == "nested spheres") {
      EXPECT_EQ(partition.pieces.size(), 3u);
      continue;
    }
    ASSERT_EQ(partition.pieces.size(), 1u) << body.name;
    EXPECT_EQ(partition.pieces[0].mesh.vertices, body.mesh.vertices) << body.name;
    EXPECT_EQ(partition.pieces[0].mesh.faces, body.mesh.faces) << body.name;
    EXPECT_EQ(partition.report.piece_label, std::vector<std::int32_t>{5});
  }
}

TEST(Partition, GivesTheSameBytesForAnyNumberOfThreads) {
  Random random(3);
  const TriangleMesh body = test_meshes::sphere(20, 30, 0.95);
  const Labels labels = voronoi(grid_around(body, 24), 12, random);
  const Partition one = partition_by_labels(body, labels, {.threads = 1});
  const Partition four = partition_by_labels(body, labels, {.threads = 4});
  ASSERT_EQ(one.pieces.size(), four.pieces.size());
  for (std::size_t p = 0; p < one.pieces.size(); ++p) {
    EXPECT_EQ(one.pieces[p].mesh.vertices, four.pieces[p].mesh.vertices);
    EXPECT_EQ(one.pieces[p].mesh.faces, four.pieces[p].mesh.faces);
    EXPECT_EQ(one.pieces[p].faces, four.pieces[p].faces);
  }
}

TEST(Partition, OfAPlanarCutHasNoStairSteps) {
  const TriangleMesh body = test_meshes::sphere(30, 40, 0.95);
  Random random(11);
  for (int round = 0; round < 12; ++round) {
    const Vec3 normal = round == 0 ? Vec3(1, 0.02, 0.01).normalized() : random.unit_vector();
    const double offset = random.uniform(-0.3, 0.3);
    const Labels grid = unit_grid<std::int32_t>(48);
    const Labels labels = filled(grid, [&](int i, int j, int k) {
      return grid.position(i, j, k).dot(normal) > offset ? 1 : 2;
    });
    const Partition partition = partition_by_labels(body, labels);
    ASSERT_EQ(partition.pieces.size(), 2u);
    const Piece& piece = partition.pieces[0];
    double area = 0, angle = 0, reach = 0;
    for (std::size_t f = 0; f < piece.faces.size(); ++f) {
      if (!piece.faces[f].is_fracture()) continue;
      const Vec3 a = area_vector2(piece.mesh, f);
      area += a.norm();
      angle += a.norm() * std::acos(std::min(1.0, std::abs(a.normalized().dot(normal))));
      for (int k = 0; k < 3; ++k) {
        reach = std::max(reach, std::abs(piece.mesh.corner(f, k).dot(normal) - offset));
      }
    }
    EXPECT_LT(angle / area * 180 / std::numbers::pi, 3.0) << "degrees, round " << round;
    EXPECT_LT(reach / grid.spacing, 0.6) << "voxels, round " << round;
  }
}

TEST(Partition, AlongTheExactPathGivesThePiecesOfTheFastOne) {
  const std::vector<Named> some = {{"sphere", test_meshes::sphere(20, 30, 0.95)},
                                   {"hollow cube", test_meshes::hollow_cube()},
                                   {"torus", test_meshes::torus(24, 12)},
                                   {"thin jar", thin_jar()}};
  for (const Named& body : some) {
    Random random(21);
    for (const bool noisy : {false, true}) {
      const Labels grid = grid_around(body.mesh, noisy ? 6 : 14);
      const Labels labels = noisy ? noise(grid, 3, random) : voronoi(grid, 8, random);
      const Partition fast = partition_by_labels(body.mesh, labels, {.minimum_voxels = 0});
      const Partition exact =
          partition_by_labels(body.mesh, labels, {.path = PartitionPath::exact});
      EXPECT_EQ(faults(body.mesh, exact, {.disjoint = !noisy, .shared_interfaces = false}), "")
          << body.name;
      ASSERT_EQ(exact.report.piece_label, fast.report.piece_label) << body.name;
      // Both carry labels in the same order; parts of one label come in any.
      std::vector<std::pair<std::int32_t, double>> a, b;
      for (std::size_t p = 0; p < fast.pieces.size(); ++p) {
        a.emplace_back(fast.report.piece_label[p], volume(fast.pieces[p].mesh));
        b.emplace_back(exact.report.piece_label[p], volume(exact.pieces[p].mesh));
      }
      const bool compare = !noisy && body.name == "sphere";  // slow: the surfaces coincide
      for (std::size_t p = 0; compare && p < fast.pieces.size(); ++p) {
        const TriangleMesh both =
            boolean(fast.pieces[p].mesh, exact.pieces[p].mesh, BooleanOperation::intersection).mesh;
        EXPECT_NEAR(volume(both), a[p].second, 1e-9 * volume(body.mesh)) << body.name;
      }
      std::sort(a.begin(), a.end());
      std::sort(b.begin(), b.end());
      for (std::size_t p = 0; p < a.size(); ++p) {
        EXPECT_NEAR(a[p].second, b[p].second, 1e-12 * volume(body.mesh)) << body.name;
      }
    }
  }
}

TEST(Partition, FollowsItsLabels) {
  // A sphere of label 2 in a box of label 1: its own piece, and a cavity of the other one.
  const TriangleMesh body = test_meshes::cube(1.8);
  const Labels grid = unit_grid<std::int32_t>(40);
  const Labels labels = filled(
      grid, [&](int i, int j, int k) { return grid.position(i, j, k).norm() < 0.6 ? 2 : 1; });
  const Partition partition = partition_by_labels(body, labels);
  ASSERT_EQ(partition.pieces.size(), 2u);
  EXPECT_EQ(partition.report.piece_label, (std::vector<std::int32_t>{1, 2}));
  const double ball = 4.0 / 3 * std::numbers::pi * std::pow(0.6, 3);
  EXPECT_NEAR(volume(partition.pieces[1].mesh) / ball, 1, 0.04);
  // Nor does it have stair steps.
  double area = 0, angle = 0;
  const TriangleMesh& round = partition.pieces[1].mesh;
  for (std::size_t f = 0; f < round.faces.size(); ++f) {
    const Vec3 a = area_vector2(round, f);
    const Vec3 radial = (round.corner(f, 0) + round.corner(f, 1) + round.corner(f, 2)).normalized();
    area += a.norm();
    angle += a.norm() * std::acos(std::min(1.0, a.normalized().dot(radial)));
  }
  EXPECT_LT(angle / area * 180 / std::numbers::pi, 4.5) << "degrees";
  EXPECT_EQ(faults(body, partition), "");
  for (const PieceFace& face : partition.pieces[1].faces) EXPECT_EQ(face.neighbour, 0);
}

TEST(Partition, SplitsWhatTheBodySeparatesAndSaysSo) {
  // The two prongs of a fork have one label, its base another.
  const TriangleMesh body = test_meshes::torus(32, 12, 0.7, 0.2);
  const Labels grid = unit_grid<std::int32_t>(32);
  const Labels labels = filled(grid, [&](int i, int j, int k) {
    return std::abs(grid.position(i, j, k).x()) < 0.3 ? 4 : 9;
  });
  const Partition partition = partition_by_labels(body, labels);
  EXPECT_EQ(partition.report.piece_label, (std::vector<std::int32_t>{4, 4, 9, 9}));
  EXPECT_EQ(partition.report.split_labels, (std::vector<std::int32_t>{4, 9}));
  EXPECT_EQ(faults(body, partition), "");
}

TEST(Partition, MergesSmallPartsIntoTheNeighbourWithTheLargestSharedAreaAndSaysSo) {
  const TriangleMesh body = test_meshes::cube(1.8);
  Labels labels =
      filled(unit_grid<std::int32_t>(20), [](int i, int, int) { return i < 10 ? 1 : 2; });
  labels.at(5, 10, 10) = 3;
  const Partition kept = partition_by_labels(body, labels, {.minimum_voxels = 0});
  EXPECT_EQ(kept.report.piece_label, (std::vector<std::int32_t>{1, 2, 3}));
  EXPECT_EQ(kept.report.merged_parts, 0u);
  const Partition merged = partition_by_labels(body, labels, {.minimum_voxels = 5});
  EXPECT_EQ(merged.report.piece_label, (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(merged.report.merged_parts, 1u);
  EXPECT_EQ(merged.report.labels_without_piece, std::vector<std::int32_t>{3});
  EXPECT_GT(merged.report.merged_volume, 0);
  EXPECT_EQ(faults(body, merged), "");
}

TEST(Partition, GivesVoxelsWithoutLabelTheNearestOne) {
  const TriangleMesh body = test_meshes::cube(1.8);
  const Labels grid = unit_grid<std::int32_t>(32);
  // Only a block in either half has a label; the border must end up in the middle.
  const Labels labels = filled(grid, [&](int i, int j, int k) {
    const Vec3 p = grid.position(i, j, k);
    const bool block = std::abs(std::abs(p.x()) - 0.4) < 0.1 && std::abs(p.y()) < 0.7;
    return !block ? (i + j) % 2 - 1 : p.x() < 0 ? 1 : 2;
  });
  const Partition partition = partition_by_labels(body, labels);
  ASSERT_EQ(partition.pieces.size(), 2u);
  EXPECT_NEAR(volume(partition.pieces[0].mesh) / volume(body), 0.5, 0.01);
  EXPECT_GT(partition.report.filled_voxels, 0u);
  EXPECT_EQ(faults(body, partition), "");
}

TEST(Partition, WorksOnGridsThatAreNoCubeAndEndShortlyBeforeTheMesh) {
  const TriangleMesh body = test_meshes::box(Vec3(0.1, 0.2, -3), Vec3(2.1, 1.3, -2.4));
  // Samples from (0.15, 0.25, -2.95) to (2.05, 1.25, -2.45): the mesh ends half a voxel beyond, and
  // in the second grid one and a half.
  for (const int missing : {0, 1}) {
    Labels grid({20 - missing, 11 - missing, 6 - missing}, Vec3(0.15, 0.25, -2.95), 0.1);
    const Labels labels = filled(grid, [](int i, int j, int) { return 1 + i / 7 + 3 * (j / 6); });
    const Partition partition = partition_by_labels(body, labels);
    EXPECT_EQ(partition.pieces.size(), 6u);
    EXPECT_EQ(faults(body, partition), "");
  }
}

TEST(Partition, SurvivesInterfacesThatCoincideWithSidesOfTheBody) {
  // A step whose inner corner lies where the labels change: the interfaces run along its walls.
  const TriangleMesh outer = test_meshes::box(Vec3(-0.75, -0.75, -0.75), Vec3(0.75, 0.75, 0.75));
  const TriangleMesh notch = test_meshes::box(Vec3(0, 0, -1), Vec3(1, 1, 1));
  const TriangleMesh body = boolean(outer, notch, BooleanOperation::difference).mesh;
  for (const int r : {8, 16}) {
    const Labels grid = unit_grid<std::int32_t>(r);
    for (const double minimum : {0.0, 0.5}) {
      const Labels labels = filled(grid, [&](int i, int j, int k) {
        const Vec3 p = grid.position(i, j, k);
        return 1 + (p.x() > 0) + 2 * (p.y() > 0) + 4 * (p.z() > 0);
      });
      const Partition partition = partition_by_labels(body, labels, {.minimum_voxels = minimum});
      EXPECT_EQ(faults(body, partition), "") << "r = " << r << ", minimum " << minimum;
      if (minimum > 0) {
        EXPECT_EQ(partition.pieces.size(), 6u);
      }
    }
  }
}

TEST(Partition, RefusesWhatItCannotCut) {
  const TriangleMesh body = test_meshes::cube(1.8);
  const auto refuses = [](const TriangleMesh& mesh, const Labels& labels, const char* word) {
    try {
      partition_by_labels(mesh, labels);
      ADD_FAILURE() << "accepted: " << word;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  const Labels good = filled(unit_grid<std::int32_t>(16), [](int, int, int) { return 1; });
  refuses({}, good, "no faces");
  refuses(test_meshes::open_box(), good, "not closed");
  TriangleMesh bad = body;
  bad.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
  refuses(bad, good, "not finite");
  bad = body;
  bad.faces[3][1] = 99;
  refuses(bad, good, "vertex 99");
  Labels labels = good;
  labels.values.pop_back();
  refuses(body, labels, "values");
  labels = good;
  labels.spacing = 0;
  refuses(body, labels, "spacing");
  labels = good;
  labels.origin.y() = std::numeric_limits<double>::infinity();
  refuses(body, labels, "origin");
  labels = good;
  labels.size = {0, 16, 16};
  refuses(body, labels, "size");
  labels = good;
  labels.origin.x() += 5;
  refuses(body, labels, "spans");
  labels = good;
  labels.spacing /= 2;
  refuses(body, labels, "spans");
  refuses(body, unit_grid<std::int32_t>(16, 0), "no label");
  refuses(body, unit_grid<std::int32_t>(16, -1), "no label");
  // Labels only where the mesh is not.
  const TriangleMesh small = test_meshes::moved(test_meshes::cube(0.3), Vec3(-0.6, 0, 0));
  refuses(small, filled(unit_grid<std::int32_t>(32), [](int i, int, int) { return i / 16; }),
          "no label");
}

}  // namespace
}  // namespace fracbench
