#include "methods/bem/strength_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/random.h"

namespace fracbench::bem {
namespace {

StrengthField random_field(double modulus, double length, std::uint64_t seed) {
  StrengthOptions options;
  options.kind = StrengthKind::random;
  options.mean = 2e6;
  options.weibull_modulus = modulus;
  options.correlation_length = length;
  options.seed = seed;
  return StrengthField(options);
}

/// Points so far apart that the field's values there are as good as independent.
std::vector<Vec3> far_points(int count, double length) {
  Random random(7);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    for (int a = 0; a < 3; ++a) p[a] = random.uniform(-100, 100) * length;
  }
  return points;
}

TEST(RandomStrength, FollowsTheWeibullDistributionOfItsModulusAndMean) {
  for (const double modulus : {2.0, 10.0}) {
    SCOPED_TRACE(modulus);
    const StrengthField field = random_field(modulus, 0.2, 3);
    std::vector<double> values;
    for (const Vec3& p : far_points(4000, 0.2)) values.push_back(field.at(p));
    std::sort(values.begin(), values.end());
    const double scale = 2e6 / std::tgamma(1 + 1 / modulus);
    double largest_gap = 0, mean = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double cdf = 1 - std::exp(-std::pow(values[i] / scale, modulus));
      const double n = static_cast<double>(values.size());
      largest_gap = std::max(
          {largest_gap, cdf - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - cdf});
      mean += values[i] / n;
    }
    // Kolmogorov and Smirnov at the 1 % level.
    EXPECT_LT(largest_gap, 1.63 / std::sqrt(4000.0));
    EXPECT_NEAR(mean / 2e6, 1, 0.03);
  }
}

TEST(RandomStrength, IsCorrelatedAsAGaussianOfTheGivenLength) {
  const double length = 0.3;
  const StrengthField field = random_field(5, length, 11);
  const std::vector<Vec3> points = far_points(4000, length);
  Random random(5);
  for (const double apart : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    double product = 0;
    for (const Vec3& p : points) {
      product += field.gaussian(p) * field.gaussian(p + apart * length * random.unit_vector());
    }
    EXPECT_NEAR(product / 4000, std::exp(-apart * apart / 2), 0.05) << apart;
  }
}

TEST(RandomStrength, DependsOnTheSeedAndOnNothingElseThanPosition) {
  const Vec3 point(0.1, -0.7, 0.3);
  EXPECT_EQ(random_field(5, 0.2, 1).at(point), random_field(5, 0.2, 1).at(point));
  // Other points asked before do not matter: no mesh, no order, no cache.
  const StrengthField field = random_field(5, 0.2, 1);
  for (const Vec3& p : far_points(10, 0.2)) field.at(p);
  EXPECT_EQ(field.at(point), random_field(5, 0.2, 1).at(point));
  EXPECT_GT(std::abs(field.at(point) / random_field(5, 0.2, 2).at(point) - 1), 1e-3);
}

TEST(RandomStrength, HasNearlyTheSameMinimumOnAGridTwiceAsFine) {
  const StrengthField field = random_field(10, 0.3, 4);  // white noise: 19 % less
  const auto minimum = [&](int n) {
    double least = 1e30;
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          least = std::min(least, field.at(2 * (Vec3(i, j, k) + Vec3::Constant(0.5)) / n));
        }
      }
    }
    return least;
  };
  EXPECT_NEAR(minimum(40) / minimum(20), 1, 0.05);
}

TEST(RandomStrength, IsPositiveAndFiniteFarIntoBothTails) {
  const StrengthField field = random_field(1, 1e-3, 9);
  for (const Vec3& p : far_points(2000, 1e-3)) {
    EXPECT_GT(field.at(p), 0);
    EXPECT_TRUE(std::isfinite(field.at(p)));
  }
}

TEST(LayeredStrength, AlternatesAlongItsDirectionOnly) {
  StrengthOptions options;
  options.kind = StrengthKind::layered;
  options.mean = 1e6;
  options.ratio = 0.25;
  options.thickness = 0.2;
  options.direction = Vec3(0, 3, 0);
  const StrengthField field(options);
  EXPECT_EQ(field.at(Vec3(5, 0.1, -2)), 1e6);
  EXPECT_EQ(field.at(Vec3(-1, 0.3, 7)), 0.25e6);
  EXPECT_EQ(field.at(Vec3(0, 0.5, 0)), 1e6);
  EXPECT_EQ(field.at(Vec3(0, -0.1, 0)), 0.25e6);
}

TEST(GrainStrength, FallsToTheRatioOnBoundariesAndIsTheMeanInside) {
  StrengthOptions options;
  options.kind = StrengthKind::grain;
  options.mean = 1e6;
  options.ratio = 0.3;
  options.grain_size = 0.3;
  options.boundary_width = 0.06;
  const StrengthField field(options);
  // Along a line through many grains: distances that touch zero at every boundary, with slopes of
  // at most one; the strength is the linear ramp that the header promises.
  const double step = 1e-3;
  int boundaries = 0, inside = 0;
  double before = field.boundary_distance(Vec3::Zero());
  for (int i = 1; i < 10000; ++i) {
    const Vec3 p = i * step * Vec3(0.6, 0.48, 0.64);
    const double distance = field.boundary_distance(p);
    ASSERT_GE(distance, 0);
    ASSERT_LE(std::abs(distance - before), step * (1 + 1e-9));
    ASSERT_NEAR(field.at(p), 1e6 * (0.3 + 0.7 * std::min(1.0, distance / 0.03)), 1);
    boundaries += distance < step / 2;
    inside += distance > 0.03;
    before = distance;
  }
  EXPECT_GT(boundaries, 10);
  EXPECT_GT(inside, 3000);
}

TEST(StrengthField, RefusesNumbersOutOfRangeAndUnknownNames) {
  StrengthOptions options;
  options.kind = StrengthKind::random;
  options.correlation_length = 0;
  EXPECT_THROW(StrengthField{options}, InputError);
  options.correlation_length = 0.1;
  options.weibull_modulus = -1;
  EXPECT_THROW(StrengthField{options}, InputError);
  options = {};
  options.mean = std::nan("");
  EXPECT_THROW(StrengthField{options}, InputError);
  EXPECT_THROW(strength_kind("grains"), InputError);
  EXPECT_EQ(strength_kind("layered"), StrengthKind::layered);
}

}  // namespace
}  // namespace fracbench::bem
