#pragma once

#include <cstdint>
#include <span>

namespace fracbench {

/// How well two divisions of one body agree, whatever the numbers of their parts.
struct PartitionAgreement {
  double adjusted_rand = 1;  ///< 1: the same; about 0: unrelated (core/adjusted_rand_index.h)
  /// H(A|B) + H(B|A) (Meila, "Comparing clusterings", 2007), bits; 0: the same.
  double variation_of_information = 0;
  /// Intersection over union of the parts of A and those of B that they are matched with, mean with
  /// the volumes of A as weights; what has no partner counts 0. The matching is one to one, and the
  /// one with the largest common volume. 1: the same.
  double matched_iou = 1;
  bool operator==(const PartitionAgreement&) const = default;
};

/// Of two labellings of the same places; only places count where both are >= 0. Where there are
/// none, the two are the same. Throws std::invalid_argument for labellings of different lengths.
PartitionAgreement partition_agreement(std::span<const std::int32_t> a,
                                       std::span<const std::int32_t> b);

}  // namespace fracbench
