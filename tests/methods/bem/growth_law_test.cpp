#include "methods/bem/growth_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fracbench::bem {
namespace {

TEST(EffectiveStressIntensity, IsThatOfTheEnergyReleaseRate) {
  EXPECT_DOUBLE_EQ(effective_stress_intensity({3, 4, 0}, 0.25), 5);
  EXPECT_DOUBLE_EQ(effective_stress_intensity({2, 0, 3}, 0.25), 4);  // 4 + 9 / 0.75 = 16
  EXPECT_DOUBLE_EQ(effective_stress_intensity({0, -2, 0}, 0.25), 2);
}

TEST(EffectiveStressIntensity, TakesNothingFromFacesPressedTogetherUnlessCompressionCounts) {
  EXPECT_DOUBLE_EQ(effective_stress_intensity({-100, 4, 0}, 0.3), 4);
  EXPECT_DOUBLE_EQ(effective_stress_intensity({-18, 4, 0}, 0.3, 6), 5);
}

TEST(DrivingStress, TurnsWhereCompressionDominates) {
  const Mat3 pulled = Vec3(2, 0, -11).asDiagonal();
  EXPECT_EQ(driving_stress(pulled, 6), pulled);
  const Mat3 pressed = Vec3(2, 0, -18).asDiagonal();
  EXPECT_LT((driving_stress(pressed, 6) - pressed / -6).norm(), 1e-14);
}

TEST(RayleighSpeed, AgreesWithTheKnownRoots) {
  // nu = 1/4: c^2 = (2 - 2 / sqrt(3)) c_s^2 (Rayleigh 1885). nu = 0: c^2 = (3 - sqrt(5)) c_s^2.
  Material material{.young_modulus = 2.5, .poisson_ratio = 0.25, .density = 1};  // c_s = 1
  EXPECT_NEAR(rayleigh_speed(material), std::sqrt(2 - 2 / std::sqrt(3.0)), 1e-12);
  material = {.young_modulus = 2, .poisson_ratio = 0, .density = 1};
  EXPECT_NEAR(rayleigh_speed(material), std::sqrt(3 - std::sqrt(5.0)), 1e-12);
}

TEST(RayleighSpeed, IsAboutNineTenthsOfTheShearSpeed) {
  for (double nu = 0; nu < 0.49; nu += 0.05) {
    const Material material{.young_modulus = 2 * (1 + nu), .poisson_ratio = nu, .density = 1};
    EXPECT_GT(rayleigh_speed(material), 0.87);
    EXPECT_LT(rayleigh_speed(material), 0.956);
  }
}

TEST(CrackSpeed, IsZeroBelowTheToughnessAndApproachesTheRayleighSpeed) {
  const Material material;
  const double limit = rayleigh_speed(material);
  EXPECT_EQ(crack_speed(999, material), 0);
  EXPECT_EQ(crack_speed(NAN, material), 0);
  EXPECT_DOUBLE_EQ(crack_speed(1001, material), 0.1 * limit);
  EXPECT_DOUBLE_EQ(crack_speed(2000, material), 0.75 * limit);
  EXPECT_NEAR(crack_speed(1e7, material), limit, 1e-7 * limit);
}

/// Hoop stress around the tip times sqrt(2 pi r) (Irwin's field).
double hoop_stress(double mode_1, double mode_2, double angle) {
  const double c = std::cos(angle / 2);
  return c * (mode_1 * c * c - 1.5 * mode_2 * std::sin(angle));
}

TEST(KinkAngle, IsWhereTheHoopStressIsLargest) {
  for (const double mode_2 : {-5.0, -1.0, -0.3, -1e-3, 1e-6, 0.1, 0.8, 2.0, 30.0}) {
    double best = -HUGE_VAL;
    double at = 0;
    for (int i = -200000; i <= 200000; ++i) {
      const double angle = std::numbers::pi * i / 200000;
      if (const double stress = hoop_stress(1, mode_2, angle); stress > best) {
        best = stress;
        at = angle;
      }
    }
    EXPECT_NEAR(kink_angle({1, mode_2, 0}, 0.3), at, 3e-5) << mode_2;
  }
}

TEST(KinkAngle, OfPureSlidingIsSeventyAndAHalfDegrees) {
  const double limit = 2 * std::atan(1 / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(kink_angle({0, 1, 0}, 0.3), -limit);
  EXPECT_DOUBLE_EQ(kink_angle({-7, -1, 0}, 0.3), limit);
}

TEST(KinkAngle, IsStableForLittleSlidingAndZeroForNone) {
  EXPECT_NEAR(kink_angle({1, 1e-18, 0}, 0.3) / -2e-18, 1, 1e-12);
  EXPECT_EQ(kink_angle({1, 0, 5}, 0.3), 0);
  EXPECT_EQ(kink_angle({0, 0, 0}, 0.3), 0);
}

TEST(KinkDirection, TurnsFromForwardTowardsTheNormal) {
  const FrontFrame frame{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  EXPECT_LT((kink_direction(frame, std::numbers::pi / 2) - Vec3(0, 1, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace fracbench::bem
