#include "geometry/boolean.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/random.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using enum BooleanOperation;
using test_meshes::box;

struct Pair {
  std::string name;
  TriangleMesh a, b;
};

/// Pairs that meet in general position, in planes, in corners, one inside the other, and apart.
std::vector<Pair> pairs() {
  const TriangleMesh cube = test_meshes::cube();
  const auto turned = [](const TriangleMesh& mesh) {
    const Mat3 turn(Eigen::AngleAxisd(0.9, Vec3(3, -1, 2).normalized()));
    return test_meshes::mapped(mesh, [&](const Vec3& v) { return Vec3(turn * v); });
  };
  return {{"cubes moved along the diagonal", cube, test_meshes::moved(cube, Vec3(1, 0.7, 0.3))},
          {"cubes that share planes", cube, test_meshes::moved(cube, Vec3(1, 0, 0))},
          {"cube and turned cube", cube, turned(cube)},
          {"sphere and torus", test_meshes::sphere(16, 24), test_meshes::torus(24, 12)},
          {"one inside the other", cube, test_meshes::cube(1)},
          {"apart", cube, test_meshes::moved(cube, Vec3(3, 0, 0))},
          {"hollow cube and plate", test_meshes::hollow_cube(),
           box(Vec3(-3, -3, -0.2), Vec3(3, 3, 0.1))}};
}

double operation_volume(const Pair& pair, BooleanOperation operation) {
  return volume(boolean(pair.a, pair.b, operation).mesh);
}

/// A face's points must lie on its source's plane, and its normal point the same way, or the other
/// way for what was cut out of a difference.
void expect_on_source(const Pair& pair, const BooleanResult& result, BooleanOperation operation) {
  ASSERT_EQ(result.source_face.size(), result.mesh.faces.size());
  for (std::size_t f = 0; f < result.mesh.faces.size(); ++f) {
    const std::int32_t source = result.source_face[f];
    const TriangleMesh& from = source >= 0 ? pair.a : pair.b;
    const std::size_t face = source >= 0 ? source : -1 - source;
    ASSERT_LT(face, from.faces.size()) << pair.name;
    const Vec3 normal = area_vector2(from, face).normalized();
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(normal.dot(result.mesh.corner(f, k) - from.corner(face, 0)), 0, 1e-12)
          << pair.name;
    }
    const Vec3 got = area_vector2(result.mesh, f);
    if (got.norm() < 1e-9) continue;
    const double turned = operation == difference && source < 0 ? -1 : 1;
    EXPECT_NEAR(turned * got.normalized().dot(normal), 1, 1e-6) << pair.name;
  }
}

TEST(Boolean, VolumesObeyInclusionAndExclusion) {
  for (const Pair& pair : pairs()) {
    const double a = volume(pair.a), b = volume(pair.b);
    const double both = operation_volume(pair, intersection);
    EXPECT_NEAR(operation_volume(pair, union_of), a + b - both, 1e-12 * (a + b)) << pair.name;
    EXPECT_NEAR(operation_volume(pair, difference), a - both, 1e-12 * (a + b)) << pair.name;
  }
}

TEST(Boolean, BoxesHaveTheVolumesThatTheirSidesSay) {
  const TriangleMesh a = box(Vec3(0, 0, 0), Vec3(2, 3, 4));
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Vec3 low(random.uniform(-1, 1.5), random.uniform(-1, 2), random.uniform(-1, 3));
    const Vec3 high =
        low + Vec3(random.uniform(0.2, 2), random.uniform(0.2, 2), random.uniform(0.2, 2));
    const Vec3 common = high.cwiseMin(Vec3(2, 3, 4)) - low.cwiseMax(Vec3(0, 0, 0));
    const double expected = common.minCoeff() > 0 ? common.prod() : 0;
    EXPECT_NEAR(volume(boolean(a, box(low, high), intersection).mesh), expected, 1e-12);
  }
}

TEST(Boolean, ResultsAreClosedAndOriented) {
  for (const Pair& pair : pairs()) {
    for (const BooleanOperation operation : {intersection, union_of, difference}) {
      const BooleanResult result = boolean(pair.a, pair.b, operation);
      if (result.mesh.empty()) continue;
      const MeshReport report = check_mesh(result.mesh, {.self_intersections = false});
      EXPECT_TRUE(report.closed && report.manifold && report.oriented)
          << pair.name << ": " << report.describe();
    }
  }
}

TEST(Boolean, FacesLieOnTheFacesTheyCameFrom) {
  for (const Pair& pair : pairs()) {
    for (const BooleanOperation operation : {intersection, union_of, difference}) {
      expect_on_source(pair, boolean(pair.a, pair.b, operation), operation);
    }
  }
}

TEST(Boolean, VerticesOfTheInputsAreKeptBitForBit) {
  const auto key = [](const Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
  int uncut = 0;
  for (const Pair& pair : pairs()) {
    const BooleanResult result = boolean(pair.a, pair.b, union_of);
    std::set<std::array<double, 3>> known;
    for (const Vec3& v : pair.a.vertices) known.insert(key(v));
    for (const Vec3& v : pair.b.vertices) known.insert(key(v));
    // A face that was not cut has the corners of its source.
    for (std::size_t f = 0; f < result.mesh.faces.size(); ++f) {
      const std::int32_t s = result.source_face[f];
      const TriangleMesh& from = s >= 0 ? pair.a : pair.b;
      const std::size_t face = s >= 0 ? s : -1 - s;
      const double whole = area_vector2(from, face).norm();
      if (std::abs(area_vector2(result.mesh, f).norm() / whole - 1) > 1e-9) continue;
      ++uncut;
      for (int k = 0; k < 3; ++k)
        EXPECT_TRUE(known.contains(key(result.mesh.corner(f, k)))) << pair.name;
    }
  }
  EXPECT_GT(uncut, 500);
}

TEST(Boolean, TheSlicesOfASolidFillIt) {
  const TriangleMesh body = test_meshes::torus(40, 20);
  double sum = 0;
  for (int i = 0; i < 7; ++i) {
    const TriangleMesh slab = box(Vec3(-2, -2, -1), Vec3(2, 2, 1));
    const TriangleMesh piece = test_meshes::mapped(slab, [&](const Vec3& v) {
      return Vec3(-1.4 + 0.4 * (i + (v.x() > 0 ? 1 : 0)), v.y(), v.z());
    });
    sum += volume(boolean(body, piece, intersection).mesh);
  }
  EXPECT_NEAR(sum / volume(body), 1, 1e-12);
}

TEST(Boolean, TheSlicesOfTheSquirrelFillIt) {
  const auto file = test_meshes::shared_mesh("squirrel.obj");
  if (file.empty()) GTEST_SKIP() << "../shared/meshes/squirrel.obj is not there";
  const TriangleMesh body = read_mesh(file);
  // Slanted planes, so that nothing is special; the slabs share their planes bit for bit.
  const Mat3 turn(Eigen::AngleAxisd(0.6, Vec3(1, -2, 0.5).normalized()));
  const auto slab = [&](int i) {
    return test_meshes::mapped(test_meshes::cube(), [&](const Vec3& v) {
      return Vec3(turn * Vec3(-2 + 0.8 * (i + (v.x() > 0 ? 1 : 0)), 2 * v.y(), 2 * v.z()));
    });
  };
  double sum = 0;
  for (int i = 0; i < 5; ++i) sum += volume(boolean(body, slab(i), intersection).mesh);
  EXPECT_NEAR(sum / volume(body), 1, 1e-12);
}

TEST(Boolean, WhatIsEmptyStaysEmpty) {
  const TriangleMesh cube = test_meshes::cube();
  EXPECT_TRUE(boolean(cube, {}, intersection).mesh.empty());
  EXPECT_TRUE(boolean({}, cube, difference).mesh.empty());
  EXPECT_EQ(boolean({}, cube, union_of).mesh.faces.size(), 12u);
  EXPECT_EQ(boolean({}, cube, union_of).source_face[11], -12);
  EXPECT_EQ(boolean(cube, {}, difference).source_face[11], 11);
  EXPECT_TRUE(boolean(cube, cube, difference).mesh.empty());
  EXPECT_TRUE(boolean(cube, test_meshes::moved(cube, Vec3(5, 0, 0)), intersection).mesh.empty());
}

TEST(Boolean, IsTheSameBytesEachTime) {
  const Pair pair = pairs()[3];
  const BooleanResult first = boolean(pair.a, pair.b, difference);
  const BooleanResult second = boolean(pair.a, pair.b, difference);
  EXPECT_EQ(first.mesh.vertices, second.mesh.vertices);
  EXPECT_EQ(first.mesh.faces, second.mesh.faces);
  EXPECT_EQ(first.source_face, second.source_face);
}

TEST(Boolean, WhatCannotBeClosedFailsWithAReason) {
  const TriangleMesh cube = test_meshes::cube();
  const auto reason = [&](const TriangleMesh& a, const TriangleMesh& b) {
    try {
      boolean(a, b, union_of);
    } catch (const MethodFailure& failure) {
      return std::string(failure.what());
    }
    return std::string();
  };
  EXPECT_NE(reason(cube, test_meshes::open_box()).find("second solid is open"), std::string::npos);
  EXPECT_NE(reason(cube, test_meshes::moved(cube, Vec3(2, 2, 0))).find("not manifold"),
            std::string::npos);
  TriangleMesh fin = cube;
  fin.faces.push_back({0, 1, 7});
  EXPECT_NE(reason(fin, cube).find("face 12"), std::string::npos);
  const TriangleMesh crossing =
      test_meshes::joined({cube, test_meshes::moved(cube, Vec3(0.5, 0.5, 0.5))});
  EXPECT_NE(
      reason(crossing, test_meshes::moved(cube, Vec3(0.2, 0.9, 0.3))).find("intersects itself"),
      std::string::npos);
}

}  // namespace
}  // namespace fracbench
