#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/random.h"

namespace fracbench {

struct BootstrapOptions {
  int resamples = 2000;
  double confidence = 0.95;
  /// Corrected for bias and skewness (BCa; Efron, "Better bootstrap confidence intervals", 1987),
  /// else the plain percentiles.
  bool corrected = true;
  /// Beyond so many clusters a resample draws only as many, which makes the cost of an interval
  /// independent of how many there are (m out of n; Bickel, Goetze and van Zwet, "Resampling fewer
  /// than n observations", 1997): the spread of the resamples about their median, times
  /// sqrt(most_clusters / clusters), is laid about the estimate. Nothing else is corrected then:
  /// bias and skewness vanish with the number of clusters.
  std::size_t most_clusters = 500;
};

struct BootstrapInterval {
  double estimate = 0;  ///< of the data as they are
  double low = 0;
  double high = 0;
  int resamples = 0;  ///< on which the statistic existed
};

/// The statistic of the chosen clusters, by their numbers, of which some may be chosen more than
/// once; none where it does not exist (the mean of nothing).
using ClusterStatistic = std::function<std::optional<double>(std::span<const std::size_t> chosen)>;

/// A confidence interval for `statistic` from data that come in `clusters` independent clusters:
/// the fragments of one collision are one cluster, since they depend on each other (their volumes
/// add up to the body's). Each resample draws as many clusters as there are, with replacement, and
/// takes each of them whole; drawing single fragments instead would give intervals that are too
/// narrow. Two methods that were given the same collisions are compared by drawing collisions and
/// taking the fragments of both: the intervals are then those of the paired comparison.
/// None where the statistic of the whole data does not exist, with fewer than two clusters, or
/// where it exists on fewer than half of the resamples.
std::optional<BootstrapInterval> cluster_bootstrap(std::size_t clusters,
                                                   const ClusterStatistic& statistic,
                                                   const BootstrapOptions& options, Random& random);

/// Several statistics of the chosen clusters, always the same ones in the same order.
using ClusterStatistics =
    std::function<std::vector<std::optional<double>>(std::span<const std::size_t> chosen)>;

/// The list of a statistic that stands alone.
ClusterStatistics only(ClusterStatistic statistic);

/// The same for statistics that have work in common: all of them of the same resamples. An interval
/// for each of `statistics`, in their order, none where the above gives none.
std::vector<std::optional<BootstrapInterval>> joint_cluster_bootstrap(
    std::size_t clusters, const ClusterStatistics& statistics, const BootstrapOptions& options,
    Random& random);

}  // namespace fracbench
