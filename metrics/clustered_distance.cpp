#include "metrics/clustered_distance.h"

#include <algorithm>
#include <cmath>

namespace fracbench {

ClusteredDistance::ClusteredDistance(const Clusters& a, const Clusters& b, Distance distance)
    : pairs_(a.size()), distance_(distance) {
  for (std::uint8_t side = 0; side < 2; ++side) {
    const Clusters& clusters = side == 0 ? a : b;
    for (std::size_t pair = 0; pair < pairs_; ++pair) {
      sizes_[side].push_back(clusters[pair].size());
      for (const double value : clusters[pair]) {
        values_.push_back({value, static_cast<std::uint32_t>(pair), side});
      }
    }
  }
  std::ranges::stable_sort(values_, {}, &Value::value);
}

bool ClusteredDistance::exists() const {
  const auto any = [](const std::vector<std::size_t>& sizes) {
    return std::ranges::any_of(sizes, [](std::size_t size) { return size > 0; });
  };
  return any(sizes_[0]) && any(sizes_[1]);
}

double ClusteredDistance::after(std::span<const std::uint8_t> swapped) const {
  std::size_t total[2] = {0, 0};
  for (std::size_t pair = 0; pair < pairs_; ++pair) {
    total[swapped[pair]] += sizes_[0][pair];
    total[1 - swapped[pair]] += sizes_[1][pair];
  }
  if (total[0] == 0 || total[1] == 0) return 0;
  const double share[2] = {1.0 / static_cast<double>(total[0]),
                           1.0 / static_cast<double>(total[1])};
  std::size_t below[2] = {0, 0};
  double result = 0;
  for (std::size_t i = 0; i + 1 < values_.size(); ++i) {
    ++below[values_[i].side ^ swapped[values_[i].pair]];
    const double step = values_[i + 1].value - values_[i].value;
    if (step == 0) continue;
    const double difference = std::abs(static_cast<double>(below[0]) * share[0] -
                                       static_cast<double>(below[1]) * share[1]);
    if (distance_ == Distance::kolmogorov_smirnov) {
      result = std::max(result, difference);
    } else {
      result += difference * step;
    }
  }
  return result;
}

double ClusteredDistance::observed() const { return after(std::vector<std::uint8_t>(pairs_, 0)); }

PermutationResult distance_test(const ClusteredDistance& distance,
                                const PermutationOptions& options, Random& random) {
  return swap_test(
      distance.pairs(),
      [&](std::span<const std::uint8_t> swapped) { return distance.after(swapped); }, options,
      random);
}

}  // namespace fracbench
