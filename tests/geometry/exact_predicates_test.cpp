#include "geometry/exact_predicates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace fracbench {
namespace {

TEST(ExactPredicates, TurnsHaveTheRightSign) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orientation({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(orientation({0, 0}, {1, 1}, {3, 3}), 0);
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  EXPECT_EQ(side_of_plane(o, x, y, Vec3(0.3, 0.2, 1)), 1);
  EXPECT_EQ(side_of_plane(o, x, y, Vec3(0.3, 0.2, -1)), -1);
  EXPECT_EQ(side_of_plane(o, x, y, Vec3(5, 7, 0)), 0);
}

TEST(ExactPredicates, OneUnitInTheLastPlaceOffTheLineIsSeen) {
  // The point 0.5 + k 2^-53 beside the diagonal through (12, 12) and (24, 24): ordinary arithmetic
  // gives noise here.
  for (int k = -20; k <= 20; ++k) {
    const double y = 0.5 + k * std::ldexp(1.0, -52);
    EXPECT_EQ(orientation({12, 12}, {24, 24}, {0.5, y}), (k > 0) - (k < 0)) << k;
    EXPECT_EQ(side_of_plane(Vec3(12, 12, 0), Vec3(24, 24, 0), Vec3(12, 12, 7), Vec3(0.5, y, 1)),
              (k < 0) - (k > 0))
        << k;
  }
}

TEST(ExactPredicates, VerySmallAndVeryLargeCoordinatesDoNotDisturb) {
  for (const double scale : {1e-170, 1e-100, 1.0, 1e100, 1e150}) {
    EXPECT_EQ(orientation({0, 0}, {scale, 2 * scale}, {2 * scale, 3 * scale}), -1) << scale;
    EXPECT_EQ(side_of_plane(Vec3(0, 0, 0), Vec3(scale, scale, 0), Vec3(0, scale, scale),
                            Vec3(scale, 2 * scale, scale)),
              0)
        << scale;
    EXPECT_EQ(side_of_plane(Vec3(0, 0, 0), Vec3(scale, scale, 0), Vec3(0, scale, scale),
                            Vec3(scale, 3 * scale, scale)),
              -1)
        << scale;
  }
}

TEST(ExactPredicates, ExchangingTwoPointsTurnsTheSign) {
  Random random(1);
  // Few distinct coordinates, so that exact zeros are common.
  const auto number = [&] { return 0.1 * static_cast<double>(random.below(5)); };
  for (int i = 0; i < 3000; ++i) {
    const Vec3 a(number(), number(), number()), b(number(), number(), number()),
        c(number(), number(), number()), d(number(), number(), number());
    const int side = side_of_plane(a, b, c, d);
    EXPECT_EQ(side_of_plane(b, c, a, d), side);
    EXPECT_EQ(side_of_plane(b, a, c, d), -side);
    EXPECT_EQ(side_of_plane(a, b, d, c), -side);
    const Point2 p{a.x(), a.y()}, q{b.x(), b.y()}, r{c.x(), c.y()};
    EXPECT_EQ(orientation(q, r, p), orientation(p, q, r));
    EXPECT_EQ(orientation(q, p, r), -orientation(p, q, r));
  }
}

}  // namespace
}  // namespace fracbench
