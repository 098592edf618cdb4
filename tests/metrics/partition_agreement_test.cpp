#include "metrics/partition_agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace fracbench {
namespace {

using Labels = std::vector<std::int32_t>;

Labels parts(std::initializer_list<std::pair<int, int>> label_and_count) {
  Labels labels;
  for (const auto& [label, count] : label_and_count) labels.insert(labels.end(), count, label);
  return labels;
}

TEST(PartitionAgreement, TheSameDivisionUnderOtherNumbersAgreesInFull) {
  const auto agreement =
      partition_agreement(parts({{1, 40}, {2, 35}, {3, 25}}), parts({{7, 40}, {1, 35}, {2, 25}}));
  EXPECT_EQ(agreement.adjusted_rand, 1);
  EXPECT_EQ(agreement.variation_of_information, 0);
  EXPECT_EQ(agreement.matched_iou, 1);
}

TEST(PartitionAgreement, OneCutMoreCostsItsEntropyAndLeavesOnePartUnmatched) {
  // One part of 100 against 75 and 25.
  const auto agreement = partition_agreement(parts({{1, 100}}), parts({{1, 75}, {2, 25}}));
  EXPECT_NEAR(agreement.variation_of_information,
              -(0.75 * std::log2(0.75) + 0.25 * std::log2(0.25)), 1e-12);
  EXPECT_NEAR(agreement.matched_iou, 0.75, 1e-12);
  // The other way round the part without a partner counts with its volume.
  const auto turned = partition_agreement(parts({{1, 75}, {2, 25}}), parts({{1, 100}}));
  EXPECT_NEAR(turned.variation_of_information, agreement.variation_of_information, 1e-12);
  EXPECT_NEAR(turned.matched_iou, 0.75 * 0.75, 1e-12);
}

TEST(PartitionAgreement, IndependentHalvesShareNoInformation) {
  const auto agreement = partition_agreement(parts({{1, 200}, {2, 200}}),
                                             parts({{1, 100}, {2, 100}, {1, 100}, {2, 100}}));
  EXPECT_NEAR(agreement.variation_of_information, 2, 1e-12);
  EXPECT_NEAR(agreement.adjusted_rand, 0, 0.01);
  EXPECT_NEAR(agreement.matched_iou, 1.0 / 3, 1e-12);
}

TEST(PartitionAgreement, MatchesForTheLargestCommonVolumeAndNotGreedily) {
  // Common volumes   B1 B2
  //             A1   60 50
  //             A2   50  0   greedy: A1-B1 and nothing for A2; best: A1-B2 and A2-B1.
  const auto agreement =
      partition_agreement(parts({{1, 110}, {2, 50}}), parts({{1, 60}, {2, 50}, {1, 50}}));
  const double a1 = 50.0 / (110 + 50 - 50);
  const double a2 = 50.0 / (50 + 110 - 50);
  EXPECT_NEAR(agreement.matched_iou, (110 * a1 + 50 * a2) / 160, 1e-12);
}

TEST(PartitionAgreement, OnlyPlacesInsideBothCount) {
  const auto agreement = partition_agreement(Labels{1, 1, 2, -1, 2}, Labels{4, 4, 5, 5, -1});
  EXPECT_EQ(agreement.adjusted_rand, 1);
  EXPECT_EQ(agreement.matched_iou, 1);
  EXPECT_EQ(partition_agreement(Labels{-1}, Labels{-1}).matched_iou, 1);
  EXPECT_THROW(partition_agreement(Labels{1}, Labels{}), std::invalid_argument);
}

}  // namespace
}  // namespace fracbench
