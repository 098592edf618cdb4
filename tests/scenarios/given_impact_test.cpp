#include "scenarios/given_impact.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/error.h"
#include "tests/scenarios/test_bodies.h"

namespace fracbench {
namespace {

const Target kTarget = {.name = "box", .mesh = test::box({1.9, 1, 1}), .material = {}};

TEST(GivenImpact, IsMovedToTheSurfaceWhereItIsNear) {
  const Impact impact = impact_at(kTarget, {0.98, 0.1, 0.2}, {-2, 0, 0}, 5e4);
  const Impulse& impulse = impact.impulses.at(0);
  EXPECT_LT((impulse.point - Vec3(0.95, 0.1, 0.2)).norm(), 1e-12);
  EXPECT_EQ(impulse.direction, Vec3(-1, 0, 0));
  EXPECT_EQ(impulse.magnitude, 5e4);
  EXPECT_LT((impulse.normal - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(impact.strikers.size(), 1u);
  EXPECT_DOUBLE_EQ(impact.break_test.balanced_force, 5e4 * 250);
}

TEST(GivenImpact, NamesTheDistanceOfAPointThatIsFar) {
  try {
    impact_at(kTarget, {1.05, 0, 0}, {-1, 0, 0}, 1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("0.1 m"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("0.95,0,0"), std::string::npos) << error.what();
  }
}

TEST(GivenImpact, RefusesValuesThatMeanNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(impact_at(kTarget, {0.95, 0, 0}, {0, 0, 0}, 1), InputError);
  EXPECT_THROW(impact_at(kTarget, {0.95, 0, 0}, {-1, 0, 0}, 0), InputError);
  EXPECT_THROW(impact_at(kTarget, {0.95, 0, 0}, {-1, 0, 0}, nan), InputError);
  EXPECT_THROW(impact_at(kTarget, {0.95, nan, 0}, {-1, 0, 0}, 1), InputError);
}

}  // namespace
}  // namespace fracbench
