#include "reports/verdict.h"

#include <gtest/gtest.h>

namespace fracbench {
namespace {

TEST(Verdict, MatchesWhenTheSameToTwoDigits) {
  EXPECT_EQ(compare_with_published(180, 181.4), Verdict::match);
  EXPECT_EQ(compare_with_published(0.0123, 0.0119), Verdict::match);
  EXPECT_EQ(compare_with_published(180, 190.0), Verdict::mismatch);
  EXPECT_EQ(compare_with_published(0, 0.0), Verdict::match);
}

TEST(Verdict, LooksIntoTheIntervalWhereThereIsOne) {
  EXPECT_EQ(compare_with_published(180, Estimate{200, 150, 250}), Verdict::within_ci);
  EXPECT_EQ(compare_with_published(180, Estimate{200, 190, 250}), Verdict::mismatch);
  EXPECT_EQ(compare_with_published(180, Estimate{180.1, 179, 181}), Verdict::match);
}

TEST(Verdict, OfNothingIsNotComparable) {
  EXPECT_EQ(compare_with_published(180, TableCell()), Verdict::not_comparable);
  EXPECT_EQ(to_string(Verdict::not_comparable), "not-comparable");
}

TEST(JudgeClaim, GoesByTheWholeInterval) {
  EXPECT_EQ(judge_claim(Estimate{1, 0.5, 2}), "holds");
  EXPECT_EQ(judge_claim(Estimate{-1, -2, -0.5}), "fails");
  EXPECT_EQ(judge_claim(Estimate{1, -0.1, 2}), "open");
  EXPECT_EQ(judge_claim(Estimate{-18, -18, -18}), "fails");
  EXPECT_EQ(judge_claim(1.0), "open") << "too few collisions for an interval";
  EXPECT_EQ(judge_claim(TableCell()), "not-comparable");
}

}  // namespace
}  // namespace fracbench
