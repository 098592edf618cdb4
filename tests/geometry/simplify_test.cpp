#include "geometry/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "geometry/measures.h"

namespace fracbench {
namespace {

/// A sphere with thousands of faces, the upper half in group 1.
struct Sphere {
  TriangleMesh mesh;
  std::vector<std::int32_t> groups;
};

Sphere sphere() {
  constexpr int n = 120;
  Sphere s;
  // Rings of latitude that include the equator, so that the groups meet in a circle.
  for (int r = 0; r <= n / 2; ++r) {
    for (int k = 0; k < n; ++k) {
      const double polar = M_PI * r / (n / 2);
      const double around = 2 * M_PI * k / n;
      s.mesh.vertices.emplace_back(std::sin(polar) * std::cos(around),
                                   std::sin(polar) * std::sin(around), std::cos(polar));
    }
  }
  for (int r = 0; r < n / 2; ++r) {
    for (int k = 0; k < n; ++k) {
      const std::int32_t a = r * n + k;
      const std::int32_t b = r * n + (k + 1) % n;
      if (r > 0) s.mesh.faces.push_back({a, a + n, b});
      if (r < n / 2 - 1) s.mesh.faces.push_back({b, a + n, b + n});
    }
  }
  for (const Face& f : s.mesh.faces) {
    double z = 0;
    for (const std::int32_t v : f) z += s.mesh.vertices[v].z();
    s.groups.push_back(z > 0 ? 1 : 0);
  }
  return s;
}

std::set<std::array<double, 3>> equator(const TriangleMesh& mesh) {
  std::set<std::array<double, 3>> points;
  for (const Vec3& v : mesh.vertices) {
    if (std::abs(v.z()) < 1e-9) points.insert({v.x(), v.y(), v.z()});
  }
  return points;
}

TEST(Simplify, HasAboutAsManyFacesAsWantedAndTheSameForm) {
  const Sphere s = sphere();
  const GroupedMesh coarse = simplify(s.mesh, s.groups, 2000);
  EXPECT_LT(coarse.mesh.faces.size(), 2400u);
  EXPECT_GT(coarse.mesh.faces.size(), 1600u);
  EXPECT_NEAR(volume(coarse.mesh) / volume(s.mesh), 1, 0.02);  // the error that simplify allows
}

TEST(Simplify, KeepsTheLineBetweenGroups) {
  const Sphere s = sphere();
  const GroupedMesh coarse = simplify(s.mesh, s.groups, 1000);
  EXPECT_EQ(equator(coarse.mesh), equator(s.mesh));
}

TEST(Simplify, SortsFacesByGroupAndLeavesSmallMeshesAlone) {
  const Sphere s = sphere();
  const GroupedMesh same = simplify(s.mesh, s.groups, s.mesh.faces.size());
  EXPECT_EQ(same.mesh.faces.size(), s.mesh.faces.size());
  EXPECT_NEAR(volume(same.mesh), volume(s.mesh), 1e-12);
  EXPECT_TRUE(std::ranges::is_sorted(same.groups));
  EXPECT_EQ(std::ranges::count(same.groups, 1), std::ranges::count(s.groups, 1));
}

TEST(Simplify, OfNothingIsNothing) { EXPECT_TRUE(simplify(TriangleMesh(), {}, 100).mesh.empty()); }

}  // namespace
}  // namespace fracbench
