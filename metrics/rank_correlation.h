#pragma once

#include <optional>
#include <span>

namespace fracbench {

/// Spearman's rank correlation; equal values share their mean rank. Nothing for fewer than two
/// pairs, and where one of the two does not vary.
std::optional<double> rank_correlation(std::span<const double> x, std::span<const double> y);

}  // namespace fracbench
