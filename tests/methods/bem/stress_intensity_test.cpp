#include "methods/bem/stress_intensity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "methods/bem/front_frames.h"
#include "methods/bem/validation/crack_meshes.h"

namespace fracbench::bem {
namespace {

const Material kGlass{.young_modulus = 7e10, .poisson_ratio = 0.22};
const FrontFrame kFrame{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

/// The opening of a penny crack of radius a under unit tension and unit shear along x.
std::vector<Vec3> penny_opening(const CrackSheet& disc, double a) {
  const double nu = kGlass.poisson_ratio;
  const double c = 8 * (1 - nu * nu) / (std::numbers::pi * kGlass.young_modulus);
  std::vector<Vec3> opening;
  for (const Vec3& x : disc.mesh.vertices) {
    const double profile = c * std::sqrt(std::max(0.0, a * a - x.squaredNorm()));
    opening.emplace_back(profile * 2 / (2 - nu), 0, profile);
  }
  return opening;
}

TEST(DisplacementCorrelation, AgreesWithTheFieldAtTheTip) {
  // u(theta = pi) - u(-pi) of Irwin's field at r = 0.01 m for K_I = K_II = K_III = 1.
  const double mu = 7e10 / 2.44;
  const double root = std::sqrt(0.01 / (2 * std::numbers::pi));
  const Vec3 opening(4 * 0.78 / mu * root, 4 * 0.78 / mu * root, 4 / mu * root);
  const StressIntensity k = displacement_correlation(opening, 0.01, kFrame, kGlass);
  EXPECT_NEAR(k.mode_1, 1, 1e-12);
  EXPECT_NEAR(k.mode_2, 1, 1e-12);
  EXPECT_NEAR(k.mode_3, 1, 1e-12);
}

TEST(DisplacementCorrelation, IsInvertedByTheOpening) {
  const StressIntensity k{3, -2, 7};
  const StressIntensity again = displacement_correlation(
      opening_from_stress_intensity(k, 0.3, kFrame, kGlass), 0.3, kFrame, kGlass);
  EXPECT_NEAR(again.mode_1, 3, 1e-12);
  EXPECT_NEAR(again.mode_2, -2, 1e-12);
  EXPECT_NEAR(again.mode_3, 7, 1e-12);
}

TEST(StressIntensityFromOpening, IsThatOfAPennyCrackInTensionAndShear) {
  const double a = 0.2;
  const double nu = kGlass.poisson_ratio;
  const double mode_1 = 2 * std::sqrt(a / std::numbers::pi);
  const double shear = 2 * mode_1 / (2 - nu);
  for (const int rings : {1, 2, 8, 16}) {
    const CrackSheet disc = disc_crack(a, rings);
    const auto k = stress_intensity_from_opening(disc, penny_opening(disc, a), kGlass);
    for (std::size_t i = 0; i < k.size(); ++i) {
      const Vec3 x = disc.mesh.vertices[disc.boundary[i]] / a;
      EXPECT_NEAR(k[i].mode_1, mode_1, 0.02 * mode_1) << rings;
      EXPECT_NEAR(k[i].mode_2, shear * x.x(), 0.02 * shear) << rings;
      EXPECT_NEAR(k[i].mode_3, shear * (1 - nu) * x.y(), 0.02 * shear) << rings;
    }
  }
}

TEST(StressIntensityFromOpening, OfAStraightCrackWithAMouthTakesTheMouthAsItsMiddle) {
  // Half of a straight crack of half-width 1: the mouth x = 0 stands for the plane of symmetry.
  CrackSheet strip;
  const int n = 8;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) strip.mesh.vertices.emplace_back(i / 8.0, 0, -j / 8.0);
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int v = j * (n + 1) + i;
      strip.mesh.faces.push_back({v, v + 1, v + n + 2});
      strip.mesh.faces.push_back({v, v + n + 2, v + n + 1});
    }
  }
  for (int i = 0; i < n; ++i) strip.boundary.push_back(i);
  for (int j = 0; j < n; ++j) strip.boundary.push_back(j * (n + 1) + n);
  for (int i = n; i > 0; --i) strip.boundary.push_back(n * (n + 1) + i);
  for (int j = n; j > 0; --j) strip.boundary.push_back(j * (n + 1));
  strip.states.assign(strip.boundary.size(), FrontState::at_surface);
  for (int j = 1; j < n; ++j) strip.states[n + j] = FrontState::advancing;
  std::vector<Vec3> opening;
  const double c = 4 * (1 - 0.22 * 0.22) / 7e10;
  for (const Vec3& x : strip.mesh.vertices) {
    opening.emplace_back(0, c * std::sqrt(std::max(0.0, 1 - x.x() * x.x())), 0);
  }
  const auto k = stress_intensity_from_opening(strip, opening, kGlass);
  for (int j = 1; j < n; ++j) {
    EXPECT_NEAR(k[n + j].mode_1, std::sqrt(std::numbers::pi), 0.01);
    EXPECT_NEAR(k[n + j].mode_2, 0, 1e-12);
  }
}

TEST(StressIntensityFromOpening, IsZeroWhereTheBoundaryDoesNotAdvance) {
  CrackSheet disc = disc_crack(0.2, 4);
  disc.states[3] = FrontState::at_surface;
  disc.states[4] = FrontState::at_crack;
  const auto k = stress_intensity_from_opening(disc, penny_opening(disc, 0.2), kGlass);
  EXPECT_EQ(k[3].mode_1, 0);
  EXPECT_EQ(k[4].mode_1, 0);
  EXPECT_GT(k[5].mode_1, 0);
}

TEST(StressIntensityFromOpening, DoesNotDependOnTheOrderOfVerticesAndFaces) {
  const CrackSheet disc = disc_crack(0.2, 5);
  const std::vector<Vec3> opening = penny_opening(disc, 0.2);
  const auto k = stress_intensity_from_opening(disc, opening, kGlass);
  CrackSheet turned = disc;  // vertices backwards, faces backwards with another first corner
  const auto last = static_cast<std::int32_t>(disc.mesh.vertices.size()) - 1;
  std::ranges::reverse(turned.mesh.vertices);
  std::ranges::reverse(turned.mesh.faces);
  for (Face& f : turned.mesh.faces) f = {last - f[1], last - f[2], last - f[0]};
  for (std::int32_t& v : turned.boundary) v = last - v;
  const auto again = stress_intensity_from_opening(
      turned, std::vector<Vec3>(opening.rbegin(), opening.rend()), kGlass);
  for (std::size_t i = 0; i < k.size(); ++i) {
    EXPECT_NEAR(again[i].mode_1, k[i].mode_1, 1e-9 * k[i].mode_1);
  }
}

TEST(OpeningFromFront, GivesTheOpeningThatTheStressIntensityBelongsTo) {
  const CrackSheet disc = disc_crack(0.2, 12);
  const std::vector<StressIntensity> k(disc.boundary.size(), StressIntensity{.mode_1 = 5});
  const std::vector<Vec3> opening = opening_from_front(disc, k, kGlass);
  EXPECT_EQ(opening[disc.boundary[7]].norm(), 0);
  const auto again = stress_intensity_from_opening(disc, opening, kGlass);
  EXPECT_NEAR(again[7].mode_1, 5, 0.5);  // sqrt(r) is no elliptic profile
}

TEST(FastStressIntensity, OfTheAuthorsIsThatOfTheEdgeCrackFormula) {
  const Mat3 stress = Vec3(0, 2, 0).asDiagonal();
  const double a = 0.3;
  const double area = std::numbers::pi * a * a;
  const StressIntensity k = fast_stress_intensity(stress, area, kFrame, FastFactors::authors());
  EXPECT_NEAR(k.mode_1, 1.1215 * 2 * std::sqrt(std::numbers::pi * a), 1e-12);
  EXPECT_EQ(k.mode_2, 0);
  EXPECT_EQ(k.mode_3, 0);
  EXPECT_NEAR(k.mode_1 / (2 * 2 * std::sqrt(a / std::numbers::pi)), 1.7617, 1e-4);
}

TEST(FastStressIntensity, CalibratedIsExactForAPennyInTensionAndShear) {
  const double a = 0.3;
  const double nu = 0.22;
  Mat3 stress = Mat3::Zero();
  stress(1, 1) = 1;
  stress(0, 1) = stress(1, 0) = 2;
  stress(2, 1) = stress(1, 2) = 3;
  const StressIntensity k =
      fast_stress_intensity(stress, std::numbers::pi * a * a, kFrame, FastFactors::calibrated(nu));
  const double root = 2 * std::sqrt(a / std::numbers::pi);
  EXPECT_NEAR(k.mode_1, root, 1e-12);
  EXPECT_NEAR(k.mode_2, 2 * root * 2 / (2 - nu), 1e-12);
  EXPECT_NEAR(k.mode_3, 3 * root * 2 * (1 - nu) / (2 - nu), 1e-12);
}

}  // namespace
}  // namespace fracbench::bem
