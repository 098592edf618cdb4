#include "metrics/summary.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace fracbench {
namespace {

TEST(Summary, of_literal_values_is_known) {
  const Summary s = summarize(std::vector<double>{2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_EQ(s.count, 8u);
  EXPECT_EQ(s.total, 40);
  EXPECT_EQ(s.mean, 5);
  EXPECT_DOUBLE_EQ(s.variance, 32.0 / 7);
  EXPECT_DOUBLE_EQ(s.deviation(), std::sqrt(32.0 / 7));
  EXPECT_EQ(s.minimum, 2);
  EXPECT_EQ(s.maximum, 9);
}

TEST(Summary, of_nothing_and_of_one_value_is_finite) {
  EXPECT_EQ(summarize({}).count, 0u);
  EXPECT_EQ(summarize({}).mean, 0);
  const Summary one = summarize(std::vector<double>{-3});
  EXPECT_EQ(one.mean, -3);
  EXPECT_EQ(one.variance, 0);
  EXPECT_EQ(one.maximum, -3);
}

TEST(Summary, variance_does_not_cancel_beside_a_large_mean) {
  // E[x^2] - E[x]^2 gives 0 or worse here.
  const double far = 1e9;
  const Summary s = summarize(std::vector<double>{far + 4, far + 7, far + 13, far + 16});
  EXPECT_DOUBLE_EQ(s.variance, 30);
}

TEST(Summary, total_keeps_terms_that_a_plain_sum_loses) {
  EXPECT_EQ(summarize(std::vector<double>{1e100, 1, -1e100, 1}).total, 2);
}

TEST(Quantile, is_linear_between_order_statistics) {
  const std::vector<double> values{40, 10, 30, 20};
  EXPECT_EQ(quantile(values, 0), 10);
  EXPECT_EQ(quantile(values, 1), 40);
  EXPECT_EQ(quantile(values, 0.5), 25);
  EXPECT_DOUBLE_EQ(quantile(values, 0.25).value(), 17.5);
  EXPECT_EQ(quantile(std::vector<double>{7}, 0.3), 7);
  EXPECT_FALSE(quantile({}, 0.5).has_value());
}

}  // namespace
}  // namespace fracbench
