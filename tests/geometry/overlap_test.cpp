#include "geometry/overlap.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/measures.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using namespace test_meshes;

TriangleMesh turned(const TriangleMesh& mesh, double angle) {
  const Mat3 turn(Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()));
  return mapped(mesh, [&](const Vec3& v) { return Vec3(turn * v); });
}

bool meshes_overlap(const TriangleMesh& a, const TriangleMesh& b) {
  const std::vector<std::reference_wrapper<const TriangleMesh>> both = {a, b};
  return !find_overlaps(both, {.threads = 1}).empty();
}

/// In both orders.
void expect_overlap(const TriangleMesh& a, const TriangleMesh& b, bool expected) {
  EXPECT_EQ(meshes_overlap(a, b), expected);
  EXPECT_EQ(meshes_overlap(b, a), expected);
}

TEST(FindOverlaps, FindsNoneWhereTheyOnlyTouch) {
  for (double angle = 0; angle < 3; angle += 0.31) {
    const auto at = [&](const Vec3& place) { return turned(moved(cube(), place), angle); };
    expect_overlap(at(Vec3(0, 0, 0)), at(Vec3(2, 0, 0)), false);    // a side
    expect_overlap(at(Vec3(0, 0, 0)), at(Vec3(2, 1, 0.5)), false);  // part of a side
    expect_overlap(at(Vec3(0, 0, 0)), at(Vec3(2, 2, 0)), false);    // an edge
    expect_overlap(at(Vec3(0, 0, 0)), at(Vec3(2, 2, 2)), false);    // a vertex
    expect_overlap(at(Vec3(0, 0, 0)), at(Vec3(5, 0, 0)), false);
  }
}

TEST(FindOverlaps, FindsNoneWhereASharedInterfaceHasOtherTriangles) {
  // The polygon at x = 0 is cut along the other diagonal on the other side.
  const TriangleMesh left = box(Vec3(-1, -1, -1), Vec3(0, 1, 1));
  TriangleMesh right = box(Vec3(0, -1, -1), Vec3(1, 1, 1));
  for (Vec3& v : right.vertices) v.x() = 1 - v.x();
  right = flipped(right);
  for (double angle = 0; angle < 3; angle += 0.31) {
    expect_overlap(turned(left, angle), turned(right, angle), false);
  }
}

TEST(FindOverlaps, FindsNoneWhereOneLiesInTheCavityOfTheOther) {
  expect_overlap(hollow_cube(), cube(0.9), false);
  expect_overlap(hollow_cube(), cube(1), false);
  expect_overlap(torus(48, 24), moved(sphere(12, 16, 0.6), Vec3(0, 0, 0)), false);
}

TEST(FindOverlaps, FindsOneWhereOneContainsOrEqualsTheOther) {
  for (const auto& [name, mesh] : solids()) {
    SCOPED_TRACE(name);
    if (bounding_box(mesh).longest_side() < 1e-3 || volume(mesh) < 1e-3)
      continue;  // thinner than
                 // the tolerance
    expect_overlap(mesh, mesh, true);
  }
  expect_overlap(cube(2), cube(1), true);
  expect_overlap(cube(2), box(Vec3(-1, -1, -1), Vec3(0, 1, 1)), true);
  expect_overlap(cube(2), box(Vec3(-1, -1, -1), Vec3(0, 0, 0)), true);
}

TEST(FindOverlaps, FindsOneWhereTheyCrossWithoutAVertexInEachOther) {
  const TriangleMesh along_x = box(Vec3(-3, -0.5, -0.5), Vec3(3, 0.5, 0.5));
  const TriangleMesh along_y = box(Vec3(-0.4, -3, -0.4), Vec3(0.4, 3, 0.4));
  for (double angle = 0; angle < 3; angle += 0.31) {
    expect_overlap(turned(along_x, angle), turned(along_y, angle), true);
  }
  expect_overlap(torus(48, 24), moved(cube(0.5), Vec3(1, 0, 0)), true);
}

TEST(FindOverlaps, BeginsAtTheTolerance) {
  for (const double depth : {1e-9, 1e-7, 9e-7}) {
    expect_overlap(cube(), moved(cube(), Vec3(2 - depth, 0.3, 0.2)), false);
  }
  for (const double depth : {1.2e-5, 1e-4, 1e-2}) {
    expect_overlap(cube(), moved(cube(), Vec3(2 - depth, 0.3, 0.2)), true);
  }
}

TEST(FindOverlaps, AgreesWithSamplingOnRandomBoxes) {
  Random random(3);
  int overlapping = 0;
  for (int i = 0; i < 300; ++i) {
    const auto random_box = [&] {
      const Vec3 half(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
      const Vec3 center = 1.2 * random.unit_vector();
      const Mat3 turn(Eigen::AngleAxisd(random.uniform(0, 3), random.unit_vector()));
      return std::pair(
          mapped(box(-half, half), [=](const Vec3& v) { return Vec3(turn * v + center); }),
          std::tuple(half, center, turn));
    };
    const auto [a, frame_a] = random_box();
    const auto [b, frame_b] = random_box();
    // A point in both, if one of many is.
    bool common = false;
    const auto& [half, center, turn] = frame_b;
    for (int n = 0; n < 4000 && !common; ++n) {
      const auto& [half_a, center_a, turn_a] = frame_a;
      const Vec3 local(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const Vec3 p = turn_a * half_a.cwiseProduct(local) + center_a;
      common = ((turn.transpose() * (p - center)).array().abs() < half.array() - 1e-5).all();
    }
    overlapping += common;
    if (common) {
      EXPECT_TRUE(meshes_overlap(a, b)) << i;
    }
  }
  EXPECT_GT(overlapping, 50);
  EXPECT_LT(overlapping, 250);
}

}  // namespace
}  // namespace fracbench
