#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace fracbench {

/// What can be said of a sample in a few numbers. The unit is that of the sample.
struct Summary {
  std::size_t count = 0;
  double total = 0;     ///< compensated sum
  double mean = 0;      ///< 0 for an empty sample
  double variance = 0;  ///< of the sample, divided by count - 1; 0 below two values
  double minimum = 0;
  double maximum = 0;

  double deviation() const;  ///< square root of the variance
};

/// One pass; the variance by Welford's recurrence ("Note on a method for calculating corrected sums
/// of squares and products", 1962), which does not cancel where the mean is large.
Summary summarize(std::span<const double> values);

/// The quantile at `p` in [0, 1] of a sample in any order: linear between the order statistics x_k
/// at p = k / (n - 1), k = 0 .. n - 1 (type 7 of Hyndman and Fan, 1996). None for an empty sample.
std::optional<double> quantile(std::span<const double> values, double p);

/// The values in ascending order.
std::vector<double> sorted(std::span<const double> values);

}  // namespace fracbench
