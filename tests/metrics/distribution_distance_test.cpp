#include "metrics/distribution_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace fracbench {
namespace {

std::vector<double> sample(Random& random, int count, const auto& quantile) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(quantile(random.uniform()));
  return values;
}

TEST(Distances, of_literal_samples_are_known) {
  const std::vector<double> a{1, 2, 3};
  const std::vector<double> b{2, 3, 4};
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov(a, b), 1.0 / 3);
  EXPECT_DOUBLE_EQ(wasserstein(a, b), 1);
  const std::vector<double> low{0, 0};
  const std::vector<double> high{5};
  EXPECT_EQ(kolmogorov_smirnov(low, high), 1);
  EXPECT_EQ(wasserstein(low, high), 5);
  // Mass 3/4 of the first is where only 1/2 of the second is: a quarter moves from 0 to 1.
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov(std::vector<double>{0, 0, 0, 1}, std::vector<double>{0, 1}),
                   0.25);
  EXPECT_DOUBLE_EQ(wasserstein(std::vector<double>{0, 0, 0, 1}, std::vector<double>{0, 1}), 0.25);
}

TEST(Distances, are_zero_from_a_sample_to_itself_in_any_order_and_multiplicity) {
  const std::vector<double> a{3, 1, 2, 2};
  const std::vector<double> b{2, 3, 2, 1, 1, 2, 2, 3};
  EXPECT_EQ(kolmogorov_smirnov(a, b), 0);
  EXPECT_EQ(wasserstein(a, b), 0);
}

TEST(Distances, are_metrics_and_scale_as_they_must) {
  Random random(3);
  for (int round = 0; round < 50; ++round) {
    const auto draw = [&](int n) { return sample(random, n, [](double u) { return u * u; }); };
    const std::vector<double> a = draw(7);
    const std::vector<double> b = draw(12);
    const std::vector<double> c = draw(30);
    EXPECT_EQ(kolmogorov_smirnov(a, b), kolmogorov_smirnov(b, a));
    EXPECT_DOUBLE_EQ(wasserstein(a, b), wasserstein(b, a));
    EXPECT_LE(kolmogorov_smirnov(a, c),
              kolmogorov_smirnov(a, b) + kolmogorov_smirnov(b, c) + 1e-15);
    EXPECT_LE(wasserstein(a, c), wasserstein(a, b) + wasserstein(b, c) + 1e-15);
    std::vector<double> moved = a;
    for (double& v : moved) v += 2;
    EXPECT_NEAR(wasserstein(a, moved), 2, 1e-14);
    std::vector<double> wide_a = a;
    std::vector<double> wide_b = b;
    for (double& v : wide_a) v *= 8;
    for (double& v : wide_b) v *= 8;
    EXPECT_EQ(kolmogorov_smirnov(wide_a, wide_b), kolmogorov_smirnov(a, b));
    EXPECT_DOUBLE_EQ(wasserstein(wide_a, wide_b), 8 * wasserstein(a, b));
  }
}

TEST(KolmogorovSmirnov, to_a_law_is_known_for_the_midpoints_of_its_quantiles) {
  // The sample at p = (i + 1/2) / n is the closest that n values can come: 1 / (2 n).
  const Mott law{.mean_volume = 0.7, .cut = 0.05};
  std::vector<double> values;
  for (int i = 0; i < 20; ++i) values.push_back(law.quantile((i + 0.5) / 20));
  EXPECT_NEAR(kolmogorov_smirnov(values, [&](double v) { return law.distribution(v); }), 0.025,
              1e-12);
}

TEST(KolmogorovSmirnov, of_a_mott_sample_shrinks_with_the_root_of_its_size) {
  // sqrt(n) D has the Kolmogorov distribution, with mean sqrt(pi / 2) ln 2 = 0.8687.
  Random random(11);
  for (const double cut : {0.0, 0.03}) {
    const Mott law{.mean_volume = 10.0 / 15, .cut = cut};
    const MottAsPrinted printed{.mean_volume = 10.0 / 15, .cut = cut};
    for (const int n : {50, 800}) {
      double mean = 0;
      double mean_printed = 0;
      const int rounds = 300;
      for (int round = 0; round < rounds; ++round) {
        const auto own = sample(random, n, [&](double u) { return law.quantile(u); });
        mean += kolmogorov_smirnov(own, [&](double v) { return law.distribution(v); });
        const auto other = sample(random, n, [&](double u) { return printed.quantile(u); });
        mean_printed +=
            kolmogorov_smirnov(other, [&](double v) { return printed.distribution(v); });
      }
      EXPECT_NEAR(mean / rounds * std::sqrt(n), 0.8687, 0.06) << n;
      EXPECT_NEAR(mean_printed / rounds * std::sqrt(n), 0.8687, 0.06) << n;
    }
  }
}

TEST(Distances, tell_the_two_mott_curves_apart) {
  Random random(12);
  const Mott law{.mean_volume = 10.0 / 15};
  const MottAsPrinted printed{.mean_volume = 10.0 / 15};
  const auto values = sample(random, 400, [&](double u) { return law.quantile(u); });
  EXPECT_LT(kolmogorov_smirnov(values, [&](double v) { return law.distribution(v); }), 0.1);
  EXPECT_GT(kolmogorov_smirnov(values, [&](double v) { return printed.distribution(v); }), 0.9);
}

TEST(Wasserstein, to_a_law_agrees_with_quadrature) {
  Random random(5);
  for (const double cut : {0.0, 0.04}) {
    const Mott law{.mean_volume = 0.5, .cut = cut};
    const auto values = sample(random, 25, [&](double u) { return cut + 3 * u; });
    // As the integral of |F_n^-1 - F^-1| over p, which is another formula for the same number.
    std::vector<double> order = values;
    std::ranges::sort(order);
    double expected = 0;
    const int steps = 4000000;
    for (int i = 0; i < steps; ++i) {
      const double p = (i + 0.5) / steps;
      expected += std::abs(order[static_cast<std::size_t>(p * 25)] - law.quantile(p)) / steps;
    }
    EXPECT_NEAR(wasserstein(values, law), expected, 1e-4);
  }
}

TEST(Wasserstein, to_a_law_of_a_single_value_far_off_is_its_distance_to_the_mean) {
  const Mott law{.mean_volume = 0.5};
  // Below all of the law nothing crosses: W = mean - value; far above: W = value - mean.
  EXPECT_NEAR(wasserstein(std::vector<double>{0}, law), 0.5, 1e-14);
  EXPECT_NEAR(wasserstein(std::vector<double>{1e6}, law), 1e6 - 0.5, 1e-6);
}

TEST(Wasserstein, of_a_mott_sample_vanishes_as_it_grows) {
  Random random(8);
  const Mott law{.mean_volume = 1, .cut = 0.1};
  const auto values = sample(random, 200000, [&](double u) { return law.quantile(u); });
  EXPECT_LT(wasserstein(values, law), 0.05);
  EXPECT_GT(wasserstein(values, Mott{.mean_volume = 2, .cut = 0.1}), 0.5);
}

TEST(Truncation, leaves_what_is_above_the_cut_in_order) {
  EXPECT_EQ(truncated(std::vector<double>{3, 0.1, 2, 0.2, 1}, 0.2), (std::vector<double>{3, 2, 1}));
}

TEST(Truncation, makes_samples_of_different_resolution_comparable) {
  // The same law seen with a coarse and with a fine cut: unequal as they are, equal above the
  // common cut.
  Random random(21);
  const Mott law{.mean_volume = 10.0 / 15};
  auto fine = sample(random, 4000, [&](double u) { return law.quantile(u); });
  auto coarse = truncated(sample(random, 4000, [&](double u) { return law.quantile(u); }), 0.1);
  EXPECT_GT(kolmogorov_smirnov(fine, coarse), 0.3);
  EXPECT_LT(kolmogorov_smirnov(truncated(fine, 0.1), coarse), 0.06);
}

}  // namespace
}  // namespace fracbench
