#include "metrics/mott.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "metrics/summary.h"

namespace fracbench {
namespace {

// Integral of f(V) dV over [from, infinity) in the variable x = cbrt(V), by Simpson's rule; the
// tail beyond x = 60 is below 1e-20 for the laws used here.
template <typename Function>
double integral(double from, const Function& f) {
  const double low = std::cbrt(from);
  const double high = 60;
  const int steps = 200000;
  const double h = (high - low) / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double x = low + i * h;
    const double weight = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * f(x * x * x) * 3 * x * x;
  }
  return sum * h / 3;
}

const double mean_volumes[] = {0.01, 10.0 / 15, 3};
const double cuts[] = {0, 1e-3, 0.05, 2};

TEST(Mott, integral_of_the_survival_function_is_the_mean_volume) {
  for (const double mean : mean_volumes) {
    const Mott law{.mean_volume = mean};
    EXPECT_NEAR(integral(0, [&](double v) { return law.survival(v); }), mean, 1e-9 * mean);
    EXPECT_DOUBLE_EQ(law.mean(), mean);
  }
}

TEST(Mott, survival_integral_agrees_with_quadrature_above_every_cut) {
  for (const double mean : mean_volumes) {
    for (const double cut : cuts) {
      const Mott law{.mean_volume = mean, .cut = cut};
      for (const double from : {cut, cut + 0.3, 2 * cut + 1}) {
        const double expected = integral(from, [&](double v) { return law.survival(v); });
        EXPECT_NEAR(law.survival_integral(from), expected, 1e-9 * expected + 1e-15)
            << mean << " " << cut << " " << from;
      }
    }
  }
}

TEST(Mott, cut_makes_the_law_conditional) {
  const Mott whole{.mean_volume = 0.7};
  const Mott above{.mean_volume = 0.7, .cut = 0.2};
  EXPECT_EQ(above.survival(0.1), 1);
  EXPECT_EQ(above.survival(0.2), 1);
  for (const double v : {0.21, 0.5, 4.0}) {
    EXPECT_NEAR(above.survival(v), whole.survival(v) / whole.survival(0.2), 1e-15);
  }
}

TEST(Mott, quantile_inverts_the_distribution_function) {
  for (const double mean : mean_volumes) {
    for (const double cut : cuts) {
      const Mott law{.mean_volume = mean, .cut = cut};
      const MottAsPrinted printed{.mean_volume = mean, .cut = cut};
      for (const double p : {0.001, 0.2, 0.5, 0.9, 0.999}) {
        EXPECT_NEAR(law.distribution(law.quantile(p)), p, 1e-12) << mean << " " << cut;
        EXPECT_NEAR(printed.distribution(printed.quantile(p)), p, 1e-9) << mean << " " << cut;
      }
      EXPECT_NEAR(law.quantile(0), cut, 1e-12 * cut);
    }
  }
}

TEST(Mott, the_cut_of_fifty_voxels_removes_the_published_share_of_fragments) {
  // Errata to the paper: about 60 / 37 / 21 % at r = 32 / 64 / 128 for a mean of 10 / 15. The body
  // fills a share of the cube [-1, 1]^3 that follows from the first figure.
  const Mott law{.mean_volume = 10.0 / 15};
  const double at_32 = law.quantile(0.60);
  EXPECT_NEAR(law.distribution(at_32 / 8), 0.37, 0.01);
  EXPECT_NEAR(law.distribution(at_32 / 64), 0.21, 0.01);
}

TEST(Mott, fit_finds_the_law_that_made_the_mean) {
  for (const double mean : mean_volumes) {
    for (const double cut : cuts) {
      const Mott law{.mean_volume = mean, .cut = cut};
      const auto fitted = Mott::with_mean(law.mean(), cut);
      ASSERT_TRUE(fitted.has_value());
      EXPECT_NEAR(fitted->mean_volume, mean, 1e-7 * mean) << cut;
      EXPECT_EQ(fitted->cut, cut);
    }
  }
  EXPECT_FALSE(Mott::with_mean(0.5, 0.5).has_value());
  EXPECT_FALSE(Mott::with_mean(0.4, 0.5).has_value());
  EXPECT_FALSE(Mott::fit(std::vector<double>{0.1, 0.2}, 0.5).has_value());
}

TEST(Mott, fit_holds_from_just_above_the_cut_to_far_beyond_it) {
  for (const double cut : {1e-12, 0.3, 1e6}) {
    for (const double excess : {1e-9, 1e-3, 1.0, 1e3, 1e12}) {
      const double mean = cut * (1 + excess);
      const auto law = Mott::with_mean(mean, cut);
      ASSERT_TRUE(law.has_value()) << cut << " " << excess;
      EXPECT_NEAR((law->mean() - cut) / (mean - cut), 1, 1e-6) << cut << " " << excess;
    }
  }
  EXPECT_FALSE(Mott::with_mean(0.3, 0.3).has_value());
}

TEST(Mott, fit_to_a_truncated_sample_recovers_the_mean_of_the_whole) {
  Random random(7);
  const Mott law{.mean_volume = 10.0 / 15};
  std::vector<double> volumes;
  for (int i = 0; i < 100000; ++i) volumes.push_back(law.quantile(random.uniform()));
  EXPECT_NEAR(Mott::fit(volumes, 0.1)->mean_volume, law.mean_volume, 0.03);
  // Forgetting the cut overestimates it.
  std::erase_if(volumes, [](double v) { return v <= 0.1; });
  EXPECT_GT(summarize(volumes).mean, law.mean_volume + 0.3);
}

TEST(MottAsPrinted, leaves_almost_all_fragments_above_the_whole_body) {
  // 0.015 of the fragments at or below V = 10, where the body itself has volume 10.
  const MottAsPrinted printed{.mean_volume = 10.0 / 15};
  EXPECT_NEAR(printed.distribution(10), 0.0153, 1e-4);
  EXPECT_EQ(printed.distribution(0), 0);
  EXPECT_GT(Mott{.mean_volume = 10.0 / 15}.distribution(10), 0.98);
}

TEST(MottAsPrinted, mean_grows_without_bound) {
  // The survival falls like V^(-1/3): a thousand times the range gives about a hundred times the
  // area.
  const MottAsPrinted printed{.mean_volume = 10.0 / 15};
  const auto area_up_to = [&](double top) {
    double sum = 0;
    const int steps = 100000;
    for (int i = 0; i < steps; ++i) sum += 1 - printed.distribution(top * (i + 0.5) / steps);
    return sum * top / steps;
  };
  EXPECT_GT(area_up_to(1e12), 50 * area_up_to(1e9));
}

}  // namespace
}  // namespace fracbench
