#include "scenarios/break_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace fracbench {
namespace {

constexpr double kStep = 1.0 / 250;

BreakTestValues values_of(const std::vector<Impulse>& impulses, double speed = 50,
                          double mass = 950) {
  const Material material;
  const Striker ball = {.mass = 2386,
                        .radius = 0.4,
                        .young_modulus = material.young_modulus,
                        .poisson_ratio = material.poisson_ratio};
  return break_test_values(impulses, std::vector<Striker>(impulses.size(), ball),
                           std::vector<ContactSpeed>(impulses.size(), {speed, mass}), material,
                           kStep);
}

Impulse blow(const Vec3& direction, double magnitude, double face_area = 0.01) {
  return {.point = -direction,
          .direction = direction,
          .magnitude = magnitude,
          .face = 0,
          .normal = -direction,
          .face_area = face_area};
}

TEST(BreakTest, OfOneBlowHasItsImpulseOverTheStepAsBalancedForce) {
  const BreakTestValues values = values_of({blow(Vec3::UnitX(), 4e4)});
  EXPECT_DOUBLE_EQ(values.total_impulse, 4e4);
  EXPECT_DOUBLE_EQ(values.balanced_force, 4e4 / kStep);
  EXPECT_DOUBLE_EQ(values.eq2_face_stress, 4e4 / kStep / 0.01);
}

TEST(BreakTest, OfTwoOpposedBlowsHasTheForceOfOneOfThem) {
  const BreakTestValues values = values_of({blow(Vec3::UnitX(), 3e4), blow(-Vec3::UnitX(), 3e4)});
  EXPECT_DOUBLE_EQ(values.total_impulse, 6e4);
  EXPECT_DOUBLE_EQ(values.balanced_force, 3e4 / kStep);
}

TEST(BreakTest, AuthorsFiresForEitherThreshold) {
  const Material material;
  EXPECT_FALSE(breaks(BreakTest::authors, {9.99e4, 9.99e6, 1e30, 1e30}, material));
  EXPECT_TRUE(breaks(BreakTest::authors, {1e5, 0, 0, 0}, material));
  EXPECT_TRUE(breaks(BreakTest::authors, {0, 1e7, 0, 0}, material));
}

TEST(BreakTest, EquationTwoComparesItsStressWithTheStrength) {
  const Material material;
  EXPECT_FALSE(breaks(BreakTest::eq2_face, {1e9, 1e9, 7.6e5, 1e9}, material));
  EXPECT_TRUE(breaks(BreakTest::eq2_face, {0, 0, 7.7e5, 0}, material));
  EXPECT_FALSE(breaks(BreakTest::eq2_patch, {1e9, 1e9, 1e9, 7.6e5}, material));
  EXPECT_TRUE(breaks(BreakTest::eq2_patch, {0, 0, 0, 7.7e5}, material));
}

TEST(BreakTest, WithThePublishedStrengthEquationTwoNeverRejects) {
  const double speed = 1e-3;
  const BreakTestValues values = values_of({blow(Vec3::UnitX(), 950 * 1.4 * speed)}, speed);
  EXPECT_TRUE(breaks(BreakTest::eq2_patch, values, Material{}));
}

TEST(BreakTest, TheContactPatchIsThatOfHertz) {
  // The force history of a Hertz contact, integrated in time, against the closed form.
  const Material material;
  const double compliance =
      2 * (1 - material.poisson_ratio * material.poisson_ratio) / material.young_modulus;
  const double stiffness = 4.0 / 3 / compliance * std::sqrt(0.4);
  double depth = 0;
  double speed = 50;
  const double dt = 1e-7;
  while (speed > 0) {
    speed -= dt * stiffness * std::pow(depth, 1.5) / 950;
    depth += dt * speed;
  }
  const double area = std::numbers::pi * 0.4 * depth;
  const BreakTestValues values = values_of({blow(Vec3::UnitX(), 4e4)});
  EXPECT_NEAR(values.eq2_patch_stress * area * kStep / 4e4, 1, 0.01);
}

TEST(BreakTest, TheOverloadTellsTheImpulseThatWouldJustBreak) {
  // Hertz's patch grows with the speed, which is that of the impulse here.
  const auto blow_at = [](double impulse) {
    return values_of({blow(Vec3::UnitX(), impulse)}, impulse / 950 / 1.4);
  };
  const Material material;
  for (const BreakTest test : {BreakTest::authors, BreakTest::eq2_face, BreakTest::eq2_patch}) {
    for (double impulse = 10; impulse < 1e7; impulse *= 1.7) {
      const double critical = impulse / overload(test, blow_at(impulse), material);
      EXPECT_FALSE(breaks(test, blow_at(0.9999 * critical), material)) << name_of(test);
      EXPECT_TRUE(breaks(test, blow_at(1.0001 * critical), material)) << name_of(test);
    }
  }
}

TEST(BreakTest, HasNamesThatReadBack) {
  for (const BreakTest test : {BreakTest::authors, BreakTest::eq2_face, BreakTest::eq2_patch}) {
    EXPECT_EQ(break_test_from(name_of(test), "here"), test);
  }
  try {
    break_test_from("eq2-fase", "suite.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("eq2-face"), std::string::npos);
  }
}

}  // namespace
}  // namespace fracbench
