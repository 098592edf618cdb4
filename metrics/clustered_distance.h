#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "metrics/paired_permutation.h"

namespace fracbench {

/// The values of each collision, such as the volumes of its fragments.
using Clusters = std::vector<std::vector<double>>;

enum class Distance : std::uint8_t { kolmogorov_smirnov, wasserstein };

/// The distance between the pooled values of two runs over the same collisions, for many ways of
/// swapping collisions between the two: values are sorted once.
class ClusteredDistance {
 public:
  /// `a` and `b` have the same number of clusters, which may be empty.
  ClusteredDistance(const Clusters& a, const Clusters& b, Distance distance);

  std::size_t pairs() const { return pairs_; }
  /// Whether both samples hold values as they are.
  bool exists() const;
  /// The distance after swapping; 0 where one sample is then empty.
  double after(std::span<const std::uint8_t> swapped) const;
  double observed() const;

 private:
  struct Value {
    double value;
    std::uint32_t pair;
    std::uint8_t side;  ///< 0: a, 1: b
  };
  std::vector<Value> values_;
  std::vector<std::size_t> sizes_[2];
  std::size_t pairs_ = 0;
  Distance distance_;
};

/// Whether the pooled values of two runs over the same collisions have one distribution; whole
/// collisions are swapped.
PermutationResult distance_test(const ClusteredDistance& distance,
                                const PermutationOptions& options, Random& random);

}  // namespace fracbench
