#include "methods/cvd/predicates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "methods/cvd/double_double.h"

namespace fracbench::cvd {
namespace {

Vec3 random_point(Random& random) {
  return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

TEST(DoubleDouble, HoldsWhatADoubleRoundsOff) {
  const DoubleDouble third = DoubleDouble(1) / DoubleDouble(3);
  const DoubleDouble rest = third * DoubleDouble(3) - DoubleDouble(1);
  EXPECT_LT(std::abs(rest.high), 1e-31);
  EXPECT_EQ((DoubleDouble(1) + DoubleDouble(1e-25) - DoubleDouble(1)).high, 1e-25);
  EXPECT_EQ((DoubleDouble(1 + 0x1p-40) * DoubleDouble(1 - 0x1p-40)).low, -0x1p-80);
}

TEST(Predicates, SeeWhichSiteIsNearer) {
  Random random(1);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 p = random_point(random), q = random_point(random), x = random_point(random);
    EXPECT_EQ(bisector_value(p, q, x).sign() > 0, (x - q).norm() < (x - p).norm());
  }
}

TEST(Predicates, DecideOffsetsFarBelowTheRoundingOfADouble) {
  // Sites mirrored in x = 0, so that the sign is that of the corner's x.
  const Vec3 p(-0.3, 0.1, 0.7), q(0.3, 0.1, 0.7);
  for (const double offset : {1e-25, -1e-25}) {
    const Corners corners{Vec3(offset, 0.4, 0.2), Vec3(1, 0, 0), Vec3(0, 1, 1)};
    const Bisector bisector{1, {bisector_value(p, q, corners[0]), {}, {}}};
    EXPECT_EQ(side_of_corner({corners, p}, 0, bisector, q), offset > 0 ? 1 : -1);
  }
}

TEST(Predicates, RefuseToDecideATie) {
  const Vec3 p(-0.3, 0.1, 0.7), q(0.3, 0.1, 0.7);
  const Corners corners{Vec3(0, 0.4, 0.2), Vec3(1, 0, 0), Vec3(0, 1, 1)};
  const Bisector bisector{1, {bisector_value(p, q, corners[0]), {}, {}}};
  EXPECT_THROW(side_of_corner({corners, p}, 0, bisector, q), Degenerate);
  EXPECT_THROW(orientation(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)), Degenerate);
  EXPECT_THROW(
      side_of_sphere(Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0, -1, 0)),
      Degenerate);
}

TEST(Predicates, AgreeWithThePointsThatTheyAreAbout) {
  Random random(2);
  int edges = 0, inner = 0;
  for (int n = 0; n < 4000; ++n) {
    const Corners t{random_point(random), random_point(random), random_point(random)};
    const Vec3 site = random_point(random), k = random_point(random), l = random_point(random),
               j = random_point(random);
    const auto over = [&](const Vec3& other) {
      return Bisector{0,
                      {bisector_value(site, other, t[0]), bisector_value(site, other, t[1]),
                       bisector_value(site, other, t[2])}};
    };
    const Bisector at_k = over(k), at_l = over(l), at_j = over(j);
    if (at_k.at[0].sign() * at_k.at[1].sign() < 0) {
      ++edges;
      const Vec3 x = point_on_edge(t[0], t[1], site, k);
      EXPECT_NEAR((x - site).norm(), (x - k).norm(), 1e-14 / (site - k).norm());
      EXPECT_EQ(side_on_edge({t, site}, 0, at_k, k, at_j, j) > 0,
                (x - j).norm() < (x - site).norm());
    }
    const Vec3 x = point_in_triangle(t, site, k, l);
    if (x.norm() > 10) continue;
    ++inner;
    EXPECT_NEAR((x - site).norm(), (x - k).norm(), 1e-13 / (site - k).norm());
    EXPECT_NEAR((x - site).norm(), (x - l).norm(), 1e-13 / (site - l).norm());
    EXPECT_EQ(side_inside({t, site}, at_k, k, at_l, l, at_j, j) > 0,
              (x - j).norm() < (x - site).norm());
  }
  EXPECT_GT(edges, 500);
  EXPECT_GT(inner, 2000);
}

TEST(Predicates, PlaceVoronoiVerticesAsFarFromAllFourSites) {
  Random random(3);
  for (int n = 0; n < 200; ++n) {
    const Vec3 a = random_point(random), b = random_point(random), c = random_point(random),
               d = random_point(random), e = random_point(random);
    const Vec3 x = voronoi_vertex(a, b, c, d);
    if (x.norm() > 10) continue;
    for (const Vec3& p : {b, c, d}) EXPECT_NEAR((x - a).norm(), (x - p).norm(), 1e-13);
    EXPECT_EQ(side_of_sphere(a, b, c, d, e) > 0, (x - e).norm() > (x - a).norm());
  }
}

}  // namespace
}  // namespace fracbench::cvd
