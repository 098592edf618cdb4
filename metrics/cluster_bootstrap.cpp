#include "metrics/cluster_bootstrap.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
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

using Values = std::vector<std::optional<double>>;

// The values of one of the statistics, where it exists.
std::vector<double> of_statistic(const std::vector<Values>& rows, std::size_t which) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Values& row : rows) {
    if (row[which]) values.push_back(*row[which]);
  }
  return values;
}

// The statistics with one cluster left out at a time.
std::vector<Values> jackknife(std::size_t clusters, const ClusterStatistics& statistics) {
  std::vector<Values> left_out;
  std::vector<std::size_t> chosen;
  for (std::size_t skip = 0; skip < clusters; ++skip) {
    chosen.clear();
    for (std::size_t c = 0; c < clusters; ++c) {
      if (c != skip) chosen.push_back(c);
    }
    left_out.push_back(statistics(chosen));
  }
  return left_out;
}

// Skewness of a statistic's influence, from leaving out one cluster at a time (Efron, eq. 6.6 of
// the 1987 paper in its jackknife form); 0 where it is not defined.
double acceleration(std::span<const double> left_out) {
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

// From resamples that drew fewer clusters than there are: their spread, `scale` times as wide.
BootstrapInterval interval_of_few(double estimate, const std::vector<double>& values, double scale,
                                  double confidence) {
  const double median = quantile(values, 0.5).value();
  const auto about_estimate = [&](double p) {
    return estimate + scale * (quantile(values, p).value() - median);
  };
  return {.estimate = estimate,
          .low = about_estimate((1 - confidence) / 2),
          .high = about_estimate((1 + confidence) / 2),
          .resamples = static_cast<int>(values.size())};
}

// From whole resamples, and what it was with one cluster left out at a time (none: not corrected).
BootstrapInterval interval_of_all(double estimate, const std::vector<double>& values,
                                  const std::optional<std::vector<double>>& left_out,
                                  double confidence) {
  double low = (1 - confidence) / 2;
  double high = 1 - low;
  if (left_out) {
    // Ties count half, so that a statistic that takes few values is not seen as biased.
    double below = 0;
    for (const double value : values) below += value < estimate ? 1 : value == estimate ? 0.5 : 0;
    const double share = below / static_cast<double>(values.size());
    const double bias = normal_quantile(share);
    const double a = acceleration(*left_out);
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
  return {.estimate = estimate,
          .low = quantile(values, low).value(),
          .high = quantile(values, high).value(),
          .resamples = static_cast<int>(values.size())};
}

}  // namespace

ClusterStatistics only(ClusterStatistic statistic) {
  return [statistic = std::move(statistic)](std::span<const std::size_t> chosen) {
    return Values{statistic(chosen)};
  };
}

std::vector<std::optional<BootstrapInterval>> joint_cluster_bootstrap(
    std::size_t clusters, const ClusterStatistics& statistics, const BootstrapOptions& options,
    Random& random) {
  std::vector<std::size_t> chosen(clusters);
  std::iota(chosen.begin(), chosen.end(), 0);
  const Values estimates = statistics(chosen);
  std::vector<std::optional<BootstrapInterval>> intervals(estimates.size());
  if (clusters < 2 || std::ranges::none_of(estimates, &std::optional<double>::has_value)) {
    return intervals;
  }

  chosen.resize(std::min(clusters, std::max<std::size_t>(options.most_clusters, 2)));
  std::vector<Values> resampled;
  resampled.reserve(options.resamples);
  for (int i = 0; i < options.resamples; ++i) {
    for (std::size_t& c : chosen) c = random.below(clusters);
    resampled.push_back(statistics(chosen));
  }
  const bool whole = chosen.size() == clusters;
  std::vector<Values> left_out;
  if (whole && options.corrected) left_out = jackknife(clusters, statistics);

  for (std::size_t s = 0; s < estimates.size(); ++s) {
    const std::vector<double> values = of_statistic(resampled, s);
    const bool exists =
        !values.empty() && 2 * values.size() >= static_cast<std::size_t>(options.resamples);
    if (!estimates[s] || !exists) continue;
    if (whole) {
      intervals[s] = interval_of_all(
          *estimates[s], values,
          options.corrected ? std::optional(of_statistic(left_out, s)) : std::nullopt,
          options.confidence);
    } else {
      const double scale =
          std::sqrt(static_cast<double>(chosen.size()) / static_cast<double>(clusters));
      intervals[s] = interval_of_few(*estimates[s], values, scale, options.confidence);
    }
  }
  return intervals;
}

std::optional<BootstrapInterval> cluster_bootstrap(std::size_t clusters,
                                                   const ClusterStatistic& statistic,
                                                   const BootstrapOptions& options,
                                                   Random& random) {
  return joint_cluster_bootstrap(clusters, only(statistic), options, random).front();
}

}  // namespace fracbench
