#include "core/adjusted_rand_index.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "core/random.h"

namespace fracbench {

namespace {

using Labels = std::vector<std::int32_t>;

TEST(AdjustedRandIndex, IsOneForTheSamePartitionUnderOtherNumbers) {
  EXPECT_EQ(adjusted_rand_index(Labels{0, 0, 1, 1, 2}, Labels{7, 7, 0, 0, 3}), 1);
}

// Worked by hand: pairs together in both 2, in a 4, in b 4, of 15.
TEST(AdjustedRandIndex, AgreesWithAWorkedExample) {
  const double by_chance = 4.0 * 4 / 15;
  EXPECT_DOUBLE_EQ(adjusted_rand_index(Labels{0, 0, 0, 1, 1, 2}, Labels{0, 0, 1, 1, 1, 2}),
                   (2 - by_chance) / (4 - by_chance));
}

TEST(AdjustedRandIndex, IsAboutZeroForUnrelatedLabels) {
  Random random(1);
  Labels a, b;
  for (int n = 0; n < 20000; ++n) {
    a.push_back(static_cast<std::int32_t>(random.below(5)));
    b.push_back(static_cast<std::int32_t>(random.below(7)));
  }
  EXPECT_NEAR(adjusted_rand_index(a, b), 0, 0.002);
}

TEST(AdjustedRandIndex, CountsOnlyPlacesThatBothLabel) {
  EXPECT_EQ(adjusted_rand_index(Labels{0, 0, 1, -1, 1}, Labels{1, 1, 2, 1, -1}), 1);
  EXPECT_EQ(adjusted_rand_index(Labels{-1, 0}, Labels{0, -1}), 1);
}

TEST(AdjustedRandIndex, RefusesLabellingsOfDifferentLengths) {
  EXPECT_THROW(adjusted_rand_index(Labels{0}, Labels{0, 1}), std::invalid_argument);
}

}  // namespace

}  // namespace fracbench
