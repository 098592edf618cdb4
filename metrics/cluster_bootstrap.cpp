#include "metrics/cluster_bootstrap.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/sum.h"
#include "metrics/summary.h"

namespace fracbench {
namespace {

double normal_distribution(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }

// Inverse of the above by bisection: 60 halvings of [-8, 8] reach the last bits.
double normal_quantile(double p) {
  double low = -8;
  double high = 8;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (normal_distribution(middle) < p ? low : high) = middle;
  }
  return (low + high) / 2;
}

// Skewness of the statistic's influence, from leaving out one cluster at a time (Efron, eq. 6.6 of
// the 1987 paper in its jackknife form); 0 where it is not defined.
double acceleration(std::size_t clusters, const ClusterStatistic& statistic) {
  std::vector<double> left_out;
  std::vector<std::size_t> chosen;
  for (std::size_t skip = 0; skip < clusters; ++skip) {
    chosen.clear();
    for (std::size_t c = 0; c < clusters; ++c) {
      if (c != skip) chosen.push_back(c);
    }
    if (const auto value = statistic(chosen)) left_out.push_back(*value);
  }
  const double mean = summarize(left_out).mean;
  Sum squares;
  Sum cubes;
  for (const double value : left_out) {
    const double d = mean - value;
    squares += d * d;
    cubes += d * d * d;
  }
  const double scale = 6 * std::pow(squares.value(), 1.5);
  return scale > 0 ? cubes.value() / scale : 0;
}

}  // namespace

std::optional<BootstrapInterval> cluster_bootstrap(std::size_t clusters,
                                                   const ClusterStatistic& statistic,
                                                   const BootstrapOptions& options,
                                                   Random& random) {
  if (clusters < 2) return std::nullopt;
  std::vector<std::size_t> chosen(clusters);
  std::iota(chosen.begin(), chosen.end(), 0);
  const auto estimate = statistic(chosen);
  if (!estimate) return std::nullopt;

  chosen.resize(std::min(clusters, std::max<std::size_t>(options.most_clusters, 2)));
  std::vector<double> values;
  values.reserve(options.resamples);
  for (int i = 0; i < options.resamples; ++i) {
    for (std::size_t& c : chosen) c = random.below(clusters);
    if (const auto value = statistic(chosen)) values.push_back(*value);
  }
  if (values.empty() || 2 * values.size() < static_cast<std::size_t>(options.resamples)) {
    return std::nullopt;
  }

  double low = (1 - options.confidence) / 2;
  double high = 1 - low;
  if (chosen.size() < clusters) {
    const double scale =
        std::sqrt(static_cast<double>(chosen.size()) / static_cast<double>(clusters));
    const double median = quantile(values, 0.5).value();
    const auto about_estimate = [&](double p) {
      return *estimate + scale * (quantile(values, p).value() - median);
    };
    return BootstrapInterval{.estimate = *estimate,
                             .low = about_estimate(low),
                             .high = about_estimate(high),
                             .resamples = static_cast<int>(values.size())};
  }
  if (options.corrected) {
    // Ties count half, so that a statistic that takes few values is not seen as biased.
    double below = 0;
    for (const double value : values) below += value < *estimate ? 1 : value == *estimate ? 0.5 : 0;
    const double share = below / static_cast<double>(values.size());
    const double bias = normal_quantile(share);
    const double a = acceleration(clusters, statistic);
    const auto corrected = [&](double p) {
      const double z = bias + normal_quantile(p);
      return normal_distribution(bias + z / (1 - a * z));
    };
    // Where every resample lies on one side of the estimate the correction has no meaning.
    if (share > 0 && share < 1) {
      low = corrected(low);
      high = corrected(high);
    }
  }
  return BootstrapInterval{.estimate = *estimate,
                           .low = quantile(values, low).value(),
                           .high = quantile(values, high).value(),
                           .resamples = static_cast<int>(values.size())};
}

}  // namespace fracbench
