#include "metrics/summary.h"

#include <algorithm>
#include <cmath>

#include "core/sum.h"

namespace fracbench {

double Summary::deviation() const { return std::sqrt(variance); }

Summary summarize(std::span<const double> values) {
  Summary summary;
  Sum total;
  double mean = 0;
  double squares = 0;
  for (const double value : values) {
    ++summary.count;
    total += value;
    const double before = value - mean;
    mean += before / static_cast<double>(summary.count);
    squares += before * (value - mean);
    summary.minimum = summary.count == 1 ? value : std::min(summary.minimum, value);
    summary.maximum = summary.count == 1 ? value : std::max(summary.maximum, value);
  }
  if (summary.count == 0) return summary;
  summary.total = total.value();
  summary.mean = summary.total / static_cast<double>(summary.count);
  if (summary.count > 1) summary.variance = squares / static_cast<double>(summary.count - 1);
  return summary;
}

std::optional<double> quantile(std::span<const double> values, double p) {
  if (values.empty()) return std::nullopt;
  const std::vector<double> order = sorted(values);
  const double place = std::clamp(p, 0.0, 1.0) * static_cast<double>(order.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, order.size() - 1);
  return std::lerp(order[below], order[above], place - static_cast<double>(below));
}

std::vector<double> sorted(std::span<const double> values) {
  std::vector<double> order(values.begin(), values.end());
  if (!std::ranges::is_sorted(order)) std::ranges::sort(order);
  return order;
}

}  // namespace fracbench
