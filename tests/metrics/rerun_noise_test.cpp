#include "metrics/rerun_noise.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "metrics/summary.h"
#include "tests/metrics/collision_generator.h"

namespace fracbench {
namespace {

std::vector<std::size_t> one_group(std::size_t n) { return std::vector<std::size_t>(n, 0); }

TEST(RerunNoise, ErrorOfAMeanIsThatOfManyReruns) {
  // Two repeats of each impact: what impacts share must not be in the noise.
  Random random(1);
  const int impacts = 400;
  std::vector<double> values;
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; i < impacts; ++i) {
    const double impact = 10 * random.normal();
    for (int repeat = 0; repeat < 2; ++repeat) {
      values.push_back(impact + 0.5 * random.normal());
      groups.push_back(i);
    }
  }
  const double expected = 0.5 * std::sqrt(2.0 / (2 * impacts));
  EXPECT_NEAR(mean_difference_error(values, groups), expected, 0.1 * expected);
  // Without knowing the repeats it is far too large, and never too small.
  EXPECT_GT(mean_difference_error(values, one_group(values.size())), 10 * expected);
}

TEST(RerunNoise, DistancesByChanceAreThoseOfRerunsOnOtherImpacts) {
  const synthetic::CollisionGenerator generator{.collisions = 60};
  for (const Distance kind : {Distance::kolmogorov_smirnov, Distance::wasserstein}) {
    std::vector<double> truth;
    for (std::uint64_t i = 0; i < 200; ++i) {
      truth.push_back(
          ClusteredDistance(generator.run(2 * i, i), generator.run(2 * i + 1, i + 1000), kind)
              .observed());
    }
    Random random(2);
    const auto chance = distances_by_chance(generator.run(7, 7), one_group(60), kind, 300, random);
    ASSERT_EQ(chance.size(), 300u);
    EXPECT_TRUE(std::ranges::is_sorted(chance));
    const double expected = summarize(truth).mean;
    EXPECT_NEAR(summarize(chance).mean, expected, 0.3 * expected);
  }
}

TEST(RerunNoise, NothingVariesWithinGroupsOfOne) {
  const std::vector<double> values = {1, 2, 3};
  const std::vector<std::size_t> groups = {0, 1, 2};
  Random random(1);
  EXPECT_EQ(mean_difference_error(values, groups), 0);
  EXPECT_TRUE(distances_by_chance({{1}, {2}}, std::vector<std::size_t>{0, 1}, Distance::wasserstein,
                                  10, random)
                  .empty());
}

TEST(RerunNoise, TheStatedShiftIsFoundAsOftenAsStated) {
  for (const std::size_t pairs : {12, 40, 160}) {
    const double error = std::sqrt(2.0 / static_cast<double>(pairs));
    const double shift = detectable_shift(error, pairs, 0.01, 0, Tail::both);
    int found = 0;
    const int rounds = 400;
    for (int round = 0; round < rounds; ++round) {
      Random random(derive_seed(round, {std::to_string(pairs)}));
      std::vector<double> differences;
      for (std::size_t i = 0; i < pairs; ++i) {
        differences.push_back(random.normal() - random.normal() + shift);
      }
      found += sign_flip_test(differences, Tail::both, {.draws = 1999}, random).p <= 0.01;
    }
    EXPECT_GE(found, 0.92 * rounds) << pairs;
    EXPECT_LE(found, 0.995 * rounds) << pairs;  // and not because it is far too large
  }
}

}  // namespace
}  // namespace fracbench
