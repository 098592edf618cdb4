#include "methods/bem/galerkin_integrals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "methods/bem/triangle_rules.h"
#include "tests/methods/bem/brute_force_pair.h"

namespace fracbench::bem {
namespace {

const Vec3 kOrigin(0, 0, 0);
const Vec3 kAlong(1, 0, 0);
const Vec3 kThird(0.5, std::numbers::sqrt3 / 2, 0);
const Corners kRegular = {kOrigin, kAlong, kThird};
const Corners kSlender = {kOrigin, kAlong, Vec3(0.3, 0.15, 0)};

double area(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2; }

Corners shifted(const Corners& corners, const Vec3& by) {
  return {corners[0] + by, corners[1] + by, corners[2] + by};
}

struct NamedPair {
  std::string name;
  Corners test;
  Corners trial;
};

std::vector<NamedPair> pairs() {
  return {
      {"itself", kRegular, {kAlong, kThird, kOrigin}},
      {"itself, slender", kSlender, kSlender},
      {"shared side, flat", kRegular, {kAlong, kOrigin, Vec3(0.5, -0.9, 0)}},
      {"shared side, right angle", kRegular, {kThird, kAlong, Vec3(0.7, 0.5, 1)}},
      {"shared side, sharp fold", kRegular, {kAlong, kOrigin, Vec3(0.5, 0.8, 0.3)}},
      {"shared side, slender", kSlender, {kAlong, kOrigin, Vec3(0.8, -0.15, 0.05)}},
      {"shared corner, flat", kRegular, {kOrigin, Vec3(-0.5, 0.9, 0), -kAlong}},
      {"shared corner, in space", kRegular, {Vec3(-0.5, 0.2, 0.7), kThird, Vec3(-0.3, -0.5, 0.6)}},
      {"shared corner, above", kRegular, {kOrigin, Vec3(0.9, 0.1, 0.4), Vec3(0.4, 0.8, 0.3)}},
      {"shared corner, slender", kSlender, {kAlong, Vec3(1.2, 0.9, 0.1), Vec3(1.1, 0.9, 0.1)}},
      {"parallel, a fifth of a side away", kRegular, shifted(kRegular, {0.1, 0.2, 0.2})},
      {"parallel, a side away", kRegular, shifted(kRegular, {0.1, 0.2, 1})},
      {"parallel, ten sides away", kRegular, shifted(kRegular, {0.1, 0.2, 10})},
      {"across", kRegular,
       shifted({kOrigin, Vec3(0.2, 0.9, 0.2), Vec3(0.1, 0.3, 0.9)}, {1.5, 0, 0})},
      {"across, five sides away", kRegular,
       shifted({kOrigin, Vec3(0.2, 0.9, 0.2), Vec3(0.1, 0.3, 0.9)}, {5, 0, 0})},
  };
}

TEST(TriangleRules, AreExactToTheirDegree) {
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  for (const auto& [points, degree] : {std::pair{3, 2}, {6, 4}, {12, 6}}) {
    for (int i = 0; i <= degree; ++i) {
      for (int j = 0; i + j <= degree; ++j) {
        double mean = 0;
        for (const TrianglePoint& p : triangle_rule(points)) {
          mean += p.weight * std::pow(p.u, i) * std::pow(p.v, j);
        }
        EXPECT_NEAR(mean, 2 * factorial(i) * factorial(j) / factorial(i + j + 2), 1e-14)
            << points << " points, u^" << i << " v^" << j;
      }
    }
  }
}

TEST(TriangleRules, GaussLegendreIsExactToTwiceItsPoints) {
  for (const int points : {1, 2, 7, 12, 24}) {
    for (int power = 0; power < 2 * points; ++power) {
      double sum = 0;
      for (const LinePoint& p : gauss_legendre(points)) sum += p.weight * std::pow(p.x, power);
      EXPECT_NEAR(sum, 1.0 / (power + 1), 1e-14) << points << " points, x^" << power;
    }
  }
}

TEST(GalerkinIntegrals, AgreeWithBruteForce) {
  PairIntegrator integrator(true);
  for (const NamedPair& pair : pairs()) {
    const PairIntegrals computed = integrator.integrate(pair.test, pair.trial);
    const PairIntegrals expected = brute_force_pair(pair.test, pair.trial);
    EXPECT_LT(single_layer_error(computed, expected), 1e-5) << pair.name;
    EXPECT_LT(double_layer_error(computed, expected, area(pair.test) * area(pair.trial)), 1e-5)
        << pair.name;
  }
}

// Two thirds of the area times the sum over the corners of height times the difference of asinh
// (tangent) between the sides: Eibert and Hansen, IEEE Trans. Antennas Propag. 1995.
TEST(GalerkinIntegrals, OfATriangleWithItselfAreTheClosedForm) {
  const double height = std::numbers::sqrt3 / 2;
  const double expected = 2 * (height / 2) / 3 * 3 * height * 2 * std::asinh(0.5 / height);
  EXPECT_NEAR(PairIntegrator(false).integrate(kRegular, kRegular).inverse_distance(), expected,
              1e-14);
}

TEST(GalerkinIntegrals, DoNotDependOnWhichTriangleComesFirst) {
  PairIntegrator integrator(false);
  for (const NamedPair& pair : pairs()) {
    const PairIntegrals one = integrator.integrate(pair.test, pair.trial);
    const PairIntegrals other = integrator.integrate(pair.trial, pair.test);
    EXPECT_LT(single_layer_error(one, other), 2e-6) << pair.name;
  }
}

// Doubling every length multiplies the integrals of degree -1 by 8, those of degree -2 by 4.
TEST(GalerkinIntegrals, ScaleWithTheSize) {
  PairIntegrator integrator(true);
  for (const NamedPair& pair : pairs()) {
    const auto doubled = [](const Corners& c) -> Corners { return {2 * c[0], 2 * c[1], 2 * c[2]}; };
    const PairIntegrals one = integrator.integrate(pair.test, pair.trial);
    const PairIntegrals two = integrator.integrate(doubled(pair.test), doubled(pair.trial));
    for (int k = 0; k < 9; ++k) {
      EXPECT_NEAR(two.values[k], (k < 6 ? 8 : 4) * one.values[k],
                  1e-12 * std::abs(one.inverse_distance()))
          << pair.name;
    }
  }
}

// Corners of a sheet that ends on another surface need not be corners there.
TEST(GalerkinIntegrals, OfTrianglesThatTouchWithoutSharingCornersConverge) {
  PairIntegrator integrator(true);
  const Corners upright = {Vec3(0.2, 0, 0), Vec3(0.9, 0, 0), Vec3(0.5, -0.4, 0.1)};
  // The lower triangle cut at the corners of the upper one: every touching part shares corners.
  const Corners parts[] = {{kOrigin, Vec3(0.2, 0, 0), kThird},
                           {Vec3(0.2, 0, 0), Vec3(0.9, 0, 0), kThird},
                           {Vec3(0.9, 0, 0), kAlong, kThird}};
  PairIntegrals expected;
  for (const Corners& part : parts) {
    const PairIntegrals share = integrator.integrate(part, upright);
    for (int k = 0; k < 9; ++k) expected.values[k] += share.values[k];
  }
  const PairIntegrals computed = integrator.integrate(kRegular, upright);
  EXPECT_LT(single_layer_error(computed, expected), 1e-4);
  EXPECT_LT(double_layer_error(computed, expected, area(kRegular) * area(upright)), 1e-3);
}

TEST(GalerkinIntegrals, OfCrossingTrianglesAreFinite) {
  const Corners crossing = {Vec3(0.5, 0.3, -0.5), Vec3(0.5, 0.3, 0.5), Vec3(0.5, -0.6, 0)};
  const PairIntegrals pair = PairIntegrator(true).integrate(kRegular, crossing);
  for (const double value : pair.values) EXPECT_TRUE(std::isfinite(value));
  EXPECT_GT(pair.inverse_distance(), 0);
}

}  // namespace
}  // namespace fracbench::bem
