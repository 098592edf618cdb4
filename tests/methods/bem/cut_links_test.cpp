#include "methods/bem/cut_links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.h"
#include "core/random.h"
#include "geometry/measures.h"
#include "scenarios/shapes.h"
#include "tests/methods/bem/sheets.h"
#include "tests/methods/cvd/bodies.h"

namespace fracbench::test {
namespace {

using bem::CutLinks;

TriangleMesh shape(const std::string& name) { return load_shape({.name = name}).mesh; }

/// Volumes of the components, by number.
std::vector<double> volumes(const CutLinks& links) {
  const auto components = links.components();
  std::vector<double> result;
  for (const std::int32_t c : components.values) {
    if (c == 0) continue;
    if (c > static_cast<std::int32_t>(result.size())) result.resize(c, 0.0);
    result[c - 1] += std::pow(components.spacing, 3);
  }
  return result;
}

struct Plane {
  Vec3 point, normal, u, v;
};

Plane random_plane(Random& random, double offset) {
  Plane plane;
  plane.normal = random.unit_vector();
  plane.u = plane.normal.unitOrthogonal();
  plane.v = plane.normal.cross(plane.u);
  plane.point = offset * plane.normal;
  return plane;
}

void cut(CutLinks& links, const std::vector<std::array<Vec3, 3>>& triangles, std::int32_t crack) {
  for (const auto& triangle : triangles) links.cut(triangle, crack);
}

std::vector<std::array<Vec3, 3>> sheet_of(const Plane& plane, double half_width, int count) {
  return sheet(count, [&](double s, double t) {
    return Vec3(plane.point + half_width * (s * plane.u + t * plane.v));
  });
}

/// Share of a cube around the origin that lies below the plane, by counting a fine grid.
double share_below(const Plane& plane, double side) {
  constexpr int n = 100;
  int below = 0;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const Vec3 p = side * (Vec3(i + 0.5, j + 0.5, k + 0.5) / n - Vec3::Constant(0.5));
        below += plane.normal.dot(p - plane.point) < 0;
      }
    }
  }
  return static_cast<double>(below) / (n * n * n);
}

TEST(CutLinks, SheetsAtAnyOrientationDivideACubeIntoTheRightVolumes) {
  const TriangleMesh cube = shape("cube");
  const double side = bounding_box(cube).longest_side(), whole = std::pow(side, 3);
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(trial);
    const Plane plane = random_plane(random, random.uniform(-0.4, 0.4));
    const double expected = share_below(plane, side) * whole;
    double coarse = 0, fine = 0;
    for (const double h : {0.1, 0.025}) {
      CutLinks links(cube, h, 1);
      EXPECT_EQ(volumes(links).size(), 1u);
      cut(links, sheet_of(plane, 1.8, 37), 0);
      const std::vector<double> parts = volumes(links);
      ASSERT_EQ(parts.size(), 2u) << "voxel " << h;
      const double error = std::min(std::abs(parts[0] - expected), std::abs(parts[1] - expected));
      (h == 0.1 ? coarse : fine) = error / whole;
    }
    EXPECT_LT(coarse, 0.05);
    EXPECT_LT(fine, 0.005);
  }
}

TEST(CutLinks, SheetsThroughTheSamplesAndAlongTheAxesDivide) {
  const TriangleMesh cube = shape("cube");
  for (int axis = 0; axis < 3; ++axis) {
    CutLinks links(cube, 0.1, 1);
    const auto grid = links.components();
    for (const double shift : {0.0, 0.03, 0.05}) {
      CutLinks fresh(cube, 0.1, 1);
      Plane plane;
      plane.normal = Vec3::Unit(axis);
      plane.u = Vec3::Unit((axis + 1) % 3);
      plane.v = Vec3::Unit((axis + 2) % 3);
      // Through a layer of samples where shift is 0.
      plane.point = (grid.position(10, 10, 10)[axis] + shift) * plane.normal;
      cut(fresh, sheet_of(plane, 1.5, 30), 3);
      EXPECT_EQ(volumes(fresh).size(), 2u) << "axis " << axis << ", shift " << shift;
    }
  }
}

TEST(CutLinks, ASheetThatEndsInTheBodyDividesNothing) {
  Random random(2);
  CutLinks one(shape("cube"), 0.05, 1);
  cut(one, sheet_of(random_plane(random, 0), 0.6, 20), 0);
  EXPECT_EQ(volumes(one).size(), 1u);
}

TEST(CutLinks, AClosedSheetDividesItsInsideFromTheRest) {
  constexpr double radius = 0.6;
  double last_error = 1;
  for (const double h : {0.1, 0.05, 0.025}) {
    CutLinks links(shape("cube"), h, 1);
    cut(links,
        sheet(40,
              [&](double s, double t) {
                const double theta = std::numbers::pi * (s + 1) / 2;
                // The seam and the poles close bit for bit.
                const double phi = t == 1 ? -std::numbers::pi : std::numbers::pi * t;
                if (s == 1) return Vec3(0.01, 0.02, -radius);
                if (s == -1) return Vec3(0.01, 0.02, radius);
                return Vec3(radius * std::sin(theta) * std::cos(phi) + 0.01,
                            radius * std::sin(theta) * std::sin(phi) + 0.02,
                            radius * std::cos(theta));
              }),
        0);
    std::vector<double> parts = volumes(links);
    ASSERT_EQ(parts.size(), 2u);
    const double expected = 4 * std::numbers::pi / 3 * std::pow(radius, 3);
    const double error = std::abs(std::min(parts[0], parts[1]) - expected) / expected;
    EXPECT_LT(error, 0.4 * h / 0.05 * 0.1);
    last_error = error;
  }
  EXPECT_LT(last_error, 0.02);
}

TEST(CutLinks, HoldsTheVolumeOfEveryGeneratedShapeInOnePart) {
  for (const ShapeInfo& info : list_shapes()) {
    if (info.source != "generated") continue;
    SCOPED_TRACE(info.name);
    const TriangleMesh mesh = shape(info.name);
    const CutLinks links(mesh, 0.025, 1);
    const std::vector<double> parts = volumes(links);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_NEAR(parts[0] / volume(mesh), 1, 0.05);
  }
}

TEST(CutLinks, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh cube = shape("cube");
  CutLinks one(cube, 0.05, 1), two(cube, 0.05, 2);
  Random random(4);
  for (int crack = 0; crack < 5; ++crack) {
    const auto triangles = sheet_of(random_plane(random, 0.1), 1.8, 20);
    cut(one, triangles, crack);
    cut(two, triangles, crack);
  }
  EXPECT_EQ(one.components().values, two.components().values);
}

TEST(CutLinks, NamesTheFirstCrackOfAnotherOnTheWay) {
  CutLinks links(shape("cube"), 0.05, 1);
  const auto wall = [](double x) {
    return sheet(20, [=](double s, double t) { return Vec3(x, s, t); });
  };
  cut(links, wall(0.2), 7);
  cut(links, wall(0.4), 9);
  const Vec3 a(0.1, 0.11, 0.12), b(0.3, 0.1, 0.1), c(0.5, 0.13, 0.07);
  EXPECT_EQ(links.crack_between(a, b, 9), 7);
  EXPECT_EQ(links.crack_between(b, a, 9), 7);
  EXPECT_EQ(links.crack_between(a, c, 1), 7);
  EXPECT_EQ(links.crack_between(c, a, 1), 9);
  EXPECT_EQ(links.crack_between(a, c, 7), 9);
  EXPECT_EQ(links.crack_between(a, b, 7), -1);
  EXPECT_EQ(links.crack_between(a, Vec3(0.1, 0.5, 0.1), -1), -1);
  EXPECT_EQ(links.crack_between(Vec3(5, 5, 5), Vec3(5.1, 5, 5), -1), -1);
}

TEST(CutLinks, KnowsWhatLiesInTheBody) {
  const TriangleMesh cube = shape("cube");
  const CutLinks links(cube, 0.05, 1);
  EXPECT_TRUE(links.inside(Vec3(0.9, -0.9, 0.3)));
  EXPECT_FALSE(links.inside(Vec3(1.0, 0, 0)));
  EXPECT_FALSE(links.inside(Vec3(9, 0, 0)));
}

TEST(CutLinks, DoesNotJoinAcrossAGapOfTheBody) {
  // Two boxes, a gap of a third of a voxel between them.
  TriangleMesh mesh;
  const auto add = [&](const Vec3& low, const Vec3& high) {
    const TriangleMesh cube = shape("cube");
    const auto base = static_cast<std::int32_t>(mesh.vertices.size());
    for (const Vec3& v : cube.vertices) {
      const Vec3 share = (v + Vec3::Constant(0.95)) / 1.9;
      mesh.vertices.push_back(low + share.cwiseProduct(high - low));
    }
    for (Face f : cube.faces) {
      for (auto& i : f) i += base;
      mesh.faces.push_back(f);
    }
  };
  add(Vec3(0, 0, 0), Vec3(1, 1, 1));
  add(Vec3(1.02, 0, 0), Vec3(2, 1, 1));
  const CutLinks links(mesh, 0.06, 1);
  EXPECT_EQ(volumes(links).size(), 2u);
}

TEST(CutLinks, SaysWhichVoxelsWouldDoForAThinShape) {
  // A plate of a hundredth of its width.
  TriangleMesh plate = shape("cube");
  for (Vec3& v : plate.vertices) v[2] *= 0.01;
  try {
    CutLinks(plate, 0.1, 1);
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string text = error.what();
    const auto at = text.find("; voxels of ");
    ASSERT_NE(at, std::string::npos) << text;
    const double enough = std::stod(text.substr(at + 12));
    EXPECT_LT(enough, 0.019);
    EXPECT_NO_THROW(CutLinks(plate, enough, 1)) << text;
  }
}

TEST(CutLinks, RefusesAGridThatDoesNotFitIntoMemory) {
  EXPECT_THROW(CutLinks(shape("cube"), 1e-5, 1), InputError);
  EXPECT_THROW(CutLinks(shape("cube"), 0, 1), InputError);
  EXPECT_THROW(CutLinks(shape("cube"), std::nan(""), 1), InputError);
}

}  // namespace
}  // namespace fracbench::test
