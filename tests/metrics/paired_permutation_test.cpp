#include "metrics/paired_permutation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "metrics/distribution_distance.h"
#include "tests/metrics/collision_generator.h"

namespace fracbench {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

TEST(PairedPermutation, CountsAllSwapsOfFewPairs) {
  Random random(1);
  // Sums of the eight sign patterns of (1, 2, 4): only that of the data is 7.
  const std::vector<double> differences = {1, 2, 4};
  const auto upper = sign_flip_test(differences, Tail::upper, {}, random);
  EXPECT_TRUE(upper.exact);
  EXPECT_DOUBLE_EQ(upper.p, 1.0 / 8);
  EXPECT_DOUBLE_EQ(sign_flip_test(differences, Tail::both, {}, random).p, 2.0 / 8);
  EXPECT_DOUBLE_EQ(sign_flip_test(differences, Tail::lower, {}, random).p, 1.0);
  // (1, 2, -1): 2 or more in 2, 4, 2 and 0 + ... : {4, 2, 2} of eight.
  EXPECT_DOUBLE_EQ(sign_flip_test(std::vector<double>{1, 2, -1}, Tail::upper, {}, random).p,
                   3.0 / 8);
}

TEST(PairedPermutation, NoDifferenceHasAPValueOfOneHoweverManyPairs) {
  for (const std::size_t pairs : {1, 5, 40, 500}) {
    Random random(2);
    const std::vector<double> none(pairs, 0.0);
    EXPECT_EQ(sign_flip_test(none, Tail::both, {}, random).p, 1.0);
  }
}

TEST(PairedPermutation, DrawnSwapsAgreeWithCountedOnes) {
  Random numbers(3);
  std::vector<double> differences;
  for (int i = 0; i < 12; ++i) differences.push_back(numbers.normal() + 0.5);
  Random random(4);
  const auto counted = sign_flip_test(differences, Tail::both, {.draws = 5000}, random);
  const auto drawn =
      sign_flip_test(differences, Tail::both, {.draws = 4000, .enough = 4000}, random);
  EXPECT_TRUE(counted.exact);
  EXPECT_FALSE(drawn.exact);
  EXPECT_NEAR(drawn.p, counted.p, 4 * std::sqrt(counted.p * (1 - counted.p) / 4000));
}

TEST(PairedPermutation, StopsEarlyWhereTheDataAreOrdinary) {
  Random random(5);
  std::vector<double> differences;
  for (int i = 0; i < 60; ++i) differences.push_back(i % 2 == 0 ? 1 : -1.01);
  const auto result = sign_flip_test(differences, Tail::both, {.draws = 100000}, random);
  EXPECT_LT(result.draws, 1000u);
  EXPECT_GT(result.p, 0.2);
}

TEST(PairedPermutation, NoDataHaveASmallerPValueThanTheSmallest) {
  for (std::size_t pairs = 1; pairs <= 10; ++pairs) {
    Random random(6);
    const std::vector<double> all_up(pairs, 1.0);
    EXPECT_DOUBLE_EQ(sign_flip_test(all_up, Tail::both, {}, random).p,
                     smallest_p(pairs, Tail::both));
    EXPECT_DOUBLE_EQ(sign_flip_test(all_up, Tail::upper, {}, random).p,
                     smallest_p(pairs, Tail::upper));
  }
}

TEST(PairedPermutation, HolmsCorrectionIsThatOfItsDefinition) {
  const std::vector<double> p = {0.01, 0.04, 0.03, 0.005};
  EXPECT_THAT(holm(p), Pointwise(DoubleNear(1e-15), {0.03, 0.06, 0.06, 0.02}));
  EXPECT_TRUE(holm({}).empty());
  EXPECT_EQ(holm(std::vector<double>{0.9, 0.8})[0], 1.0);
}

TEST(ClusteredDistance, IsThatOfThePooledValues) {
  const synthetic::CollisionGenerator generator{.collisions = 9, .fragments = 7};
  const Clusters a = generator.run(1, 2);
  const Clusters b = generator.run(1, 3, 1.3);
  const std::vector<std::uint8_t> swapped = {0, 1, 1, 0, 0, 1, 0, 1, 0};
  std::vector<double> first;
  std::vector<double> second;
  for (std::size_t c = 0; c < a.size(); ++c) {
    const auto& x = swapped[c] ? b[c] : a[c];
    const auto& y = swapped[c] ? a[c] : b[c];
    first.insert(first.end(), x.begin(), x.end());
    second.insert(second.end(), y.begin(), y.end());
  }
  EXPECT_NEAR(ClusteredDistance(a, b, Distance::kolmogorov_smirnov).after(swapped),
              kolmogorov_smirnov(first, second), 1e-14);
  EXPECT_NEAR(ClusteredDistance(a, b, Distance::wasserstein).after(swapped),
              wasserstein(first, second), 1e-12);
}

TEST(ClusteredDistance, OfARunToItselfIsZeroAndTestsToOne) {
  const synthetic::CollisionGenerator generator;
  const Clusters a = generator.run(1, 2);
  for (const Distance kind : {Distance::kolmogorov_smirnov, Distance::wasserstein}) {
    const ClusteredDistance distance(a, a, kind);
    Random random(1);
    EXPECT_EQ(distance.observed(), 0);
    EXPECT_EQ(distance_test(distance, {}, random).p, 1);
  }
}

TEST(ClusteredDistance, EmptySamplesHaveNone) {
  EXPECT_FALSE(ClusteredDistance({{}, {}}, {{1}, {2}}, Distance::kolmogorov_smirnov).exists());
  EXPECT_TRUE(ClusteredDistance({{}, {1}}, {{1}, {}}, Distance::kolmogorov_smirnov).exists());
}

}  // namespace
}  // namespace fracbench
