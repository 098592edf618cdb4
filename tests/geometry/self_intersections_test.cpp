#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "geometry/check_mesh.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using namespace test_meshes;
using FacePair = std::pair<std::int32_t, std::int32_t>;

bool two_faces_intersect(const std::vector<Vec3>& vertices, const Face& f, const Face& g) {
  return !self_intersections({vertices, {f, g}}).empty();
}

/// The answer must not depend on how the corners and faces are numbered.
void expect_for_all_numberings(const std::vector<Vec3>& vertices, Face f, Face g, bool expected) {
  std::sort(f.begin(), f.end());
  do {
    Face h = g;
    std::sort(h.begin(), h.end());
    do {
      EXPECT_EQ(two_faces_intersect(vertices, f, h), expected);
      EXPECT_EQ(two_faces_intersect(vertices, h, f), expected);
    } while (std::next_permutation(h.begin(), h.end()));
  } while (std::next_permutation(f.begin(), f.end()));
}

TEST(SelfIntersections, OfFacesThatShareNoVertex) {
  const Face f = {0, 1, 2}, g = {3, 4, 5};
  std::vector<Vec3> v = {Vec3(0, 0, 0),  Vec3(4, 0, 0), Vec3(0, 4, 0),
                         Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(5, 5, 1)};
  expect_for_all_numberings(v, f, g, true);  // pierces
  v[4].z() = -2, v[5].z() = -1;
  expect_for_all_numberings(v, f, g, false);  // below
  v[4].z() = 0;
  expect_for_all_numberings(v, f, g, true);  // a vertex touches the inside
  v[4] = Vec3(2, 2, 0);
  expect_for_all_numberings(v, f, g, true);  // a vertex touches an edge
  v[3] = Vec3(1, 0.5, 0), v[4] = Vec3(2, 0.5, 0), v[5] = Vec3(1, 1.5, 0);
  expect_for_all_numberings(v, f, g, true);  // one in the other, in a plane
  for (int i = 3; i < 6; ++i) v[i] += Vec3(10, 0, 0);
  expect_for_all_numberings(v, f, g, false);  // apart in a plane
}

TEST(SelfIntersections, OfFacesThatShareAVertex) {
  const Face f = {0, 1, 2}, g = {0, 3, 4};
  std::vector<Vec3> v = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(1, 1, 1),
                         Vec3(1, 1, -1)};
  expect_for_all_numberings(v, f, g, true);  // an edge pierces
  v[3] = Vec3(9, 9, 5), v[4] = Vec3(9, 9, -5);
  expect_for_all_numberings(v, f, g, true);  // pierced by the edge of the first
  v[3] = Vec3(-1, -1, 1), v[4] = Vec3(-1, -1, -1);
  expect_for_all_numberings(v, f, g, false);  // through the plane on the other side
  v[3] = Vec3(1, 1, 1), v[4] = Vec3(2, 1, 1);
  expect_for_all_numberings(v, f, g, false);  // above
  v[3] = Vec3(1, 1, 0), v[4] = Vec3(2, 1, 1);
  expect_for_all_numberings(v, f, g, true);  // touches along an edge of its own
  v[3] = Vec3(-1, 0, 0), v[4] = Vec3(0, -1, 0);
  expect_for_all_numberings(v, f, g, false);  // opposite corners of a plane
  v[3] = Vec3(5, 0, 0), v[4] = Vec3(0, -1, 0);
  expect_for_all_numberings(v, f, g, true);  // edges that lie on each other
}

TEST(SelfIntersections, OfFacesThatShareAnEdge) {
  const Face f = {0, 1, 2}, g = {0, 1, 3};
  std::vector<Vec3> v = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(0, 3, 1e-300)};
  expect_for_all_numberings(v, f, g, false);  // folded, but not flat
  v[3].z() = 0;
  expect_for_all_numberings(v, f, g, true);  // folded flat
  v[3].y() = -1e-300;
  expect_for_all_numberings(v, f, g, false);  // side by side in a plane
  expect_for_all_numberings(v, f, f, true);   // the same face twice
}

TEST(SelfIntersections, SeeSharedVerticesByPlaceAndNotByIndex) {
  const TriangleMesh two = joined({cube(), moved(cube(), Vec3(2, 2, 2))});
  EXPECT_TRUE(self_intersections(two).empty());
  EXPECT_TRUE(self_intersections(welded(two)).empty());
  TriangleMesh near = two;
  for (std::size_t v = 8; v < 16; ++v) near.vertices[v] -= Vec3::Constant(1e-15);
  EXPECT_FALSE(self_intersections(near).empty());
}

TEST(SelfIntersections, TellTouchingFromCrossingAtACommonEdge) {
  // A wedge with its sharp edge along z, between two angles.
  const auto wedge = [](double from, double to) {
    TriangleMesh mesh;
    for (const double z : {-1.0, 1.0}) {
      mesh.vertices.emplace_back(0, 0, z);
      for (const double angle : {from, to}) {
        mesh.vertices.emplace_back(std::cos(angle), std::sin(angle), z);
      }
    }
    mesh.faces = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                  {0, 3, 5}, {0, 5, 2}, {1, 2, 5}, {1, 5, 4}};
    return mesh;
  };
  for (double turn = 0; turn < 6; turn += 0.37) {
    const auto both = [&](double a, double b, double c, double d) {
      return joined({wedge(turn + a, turn + b), wedge(turn + c, turn + d)});
    };
    EXPECT_TRUE(self_intersections(both(0, 1, 1.5, 2.5)).empty()) << turn;
    EXPECT_TRUE(self_intersections(welded(both(0, 1, 3, 5.5))).empty()) << turn;
    EXPECT_FALSE(self_intersections(both(0, 1, 0.5, 1.5)).empty()) << turn;
    EXPECT_FALSE(self_intersections(both(0, 2, 0.5, 1.5)).empty()) << turn;
  }
}

TEST(SelfIntersections, FindACrossingThatOnlyTheCommonEdgeShows) {
  // Four half planes from one edge, as two sheets that cross there: no two faces meet elsewhere.
  TriangleMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0),     Vec3(0, 0, 1),    Vec3(1, 1, 0.5),
                   Vec3(-1, -1, 0.5), Vec3(-1, 1, 0.5), Vec3(1, -1, 0.5)};
  // The first sheet runs from 2 to 3, the second from 4 to 5.
  mesh.faces = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}};
  EXPECT_THAT(self_intersections(mesh), testing::ElementsAre(FacePair(0, 2), FacePair(1, 3)));
  // Two roofs that only touch along their ridges.
  mesh.faces = {{0, 1, 2}, {1, 0, 4}, {0, 1, 3}, {1, 0, 5}};
  EXPECT_TRUE(self_intersections(mesh).empty());
}

TEST(SelfIntersections, OfCrossingSolidsAreTheFacesThatCross) {
  const TriangleMesh mesh = joined({cube(), moved(cube(0.5), Vec3(1, 0.1, 0.2))});
  const auto pairs = self_intersections(mesh);
  ASSERT_FALSE(pairs.empty());
  for (const auto& [f, g] : pairs) {
    EXPECT_LT(f, 12);
    EXPECT_GE(g, 12);
    // Only the side at x = 1 is met.
    for (int k = 0; k < 3; ++k) EXPECT_EQ(mesh.corner(f, k).x(), 1);
  }
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
}

/// Triangles with few different coordinates, so that they touch in every way.
TriangleMesh random_soup(int faces, std::uint64_t seed, int range) {
  Random random(seed);
  TriangleMesh mesh;
  for (int v = 0; v < faces; ++v) {
    const auto coordinate = [&] { return static_cast<double>(random.below(range)); };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    mesh.vertices.emplace_back(x, y, z);
  }
  for (int f = 0; f < faces; ++f) {
    Face face;
    for (auto& v : face) v = static_cast<std::int32_t>(random.below(faces));
    mesh.faces.push_back(face);
  }
  return mesh;
}

TEST(SelfIntersections, OfAWholeAreThoseOfItsPairs) {
  for (const int range : {4, 12}) {
    const TriangleMesh mesh = random_soup(60, 7, range);
    std::vector<FacePair> expected;
    for (std::int32_t f = 0; f < 60; ++f) {
      for (std::int32_t g = f + 1; g < 60; ++g) {
        if (two_faces_intersect(mesh.vertices, mesh.faces[f], mesh.faces[g])) {
          expected.emplace_back(f, g);
        }
      }
    }
    const auto all = self_intersections(mesh, 1, 100000);
    EXPECT_GT(expected.size(), 100u);
    // Crossings at common edges take four faces; all others take two.
    EXPECT_TRUE(std::includes(all.begin(), all.end(), expected.begin(), expected.end()));
    EXPECT_LE(all.size(), expected.size() + 40);
  }
}

TEST(SelfIntersections, DoNotDependOnTheNumberOfThreadsAndTheLimitCutsTheEnd) {
  const TriangleMesh mesh = random_soup(1200, 3, 12);
  const auto all = self_intersections(mesh, 1, 10000000);
  ASSERT_GT(all.size(), 1000u);
  EXPECT_EQ(self_intersections(mesh, 2, 10000000), all);
  for (const std::size_t limit : {1u, 10u, 1000u}) {
    const std::vector<FacePair> expected(all.begin(), all.begin() + limit);
    EXPECT_EQ(self_intersections(mesh, 2, limit), expected);
  }
}

TEST(SelfIntersections, AreFoundAmongManyFacesAroundOneVertex) {
  // Oblique, so that no coordinate is the same by itself.
  constexpr int sides = 1500;
  TriangleMesh fan;
  fan.vertices.push_back(Vec3(1, 2, 3));
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    const double x = std::cos(angle), y = std::sin(angle);
    fan.vertices.push_back(Vec3(1 + x + y / 2, 2 + y - x / 3, 3 + x / 4 + y));
    fan.faces.push_back({0, 1 + i, 1 + (i + 1) % sides});
  }
  EXPECT_EQ(self_intersections(fan, 2), std::vector<FacePair>{});
  // A face that goes through the flat cone of another one, with their corner in common.
  const Vec3 ahead = (fan.vertices[1] + fan.vertices[2]) / 2 - fan.vertices[0];
  fan.vertices.push_back(fan.vertices[0] + ahead / 2 + Vec3(0, 0, 1));
  fan.vertices.push_back(fan.vertices[0] + ahead / 2 - Vec3(0, 0, 1));
  fan.faces.push_back({0, sides + 1, sides + 2});
  EXPECT_EQ(self_intersections(fan, 2), (std::vector<FacePair>{{0, sides}}));
}

TEST(SelfIntersections, EndEarlyWhereEverythingIntersects) {
  TriangleMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  mesh.faces.assign(300000, {0, 1, 2});
  EXPECT_EQ(self_intersections(mesh).size(), 1000u);
}

}  // namespace
}  // namespace fracbench
