#pragma once

#include "metrics/metric.h"

namespace fracbench {

/// Whether fragments near the impact are smaller: "size_distance_correlation", Spearman's rank
/// correlation of the volumes of the fragments and the distances of their centres of mass from the
/// point of the strongest impulse that broke the target, in its mesh frame. 1: the farther, the
/// larger. Left out for fewer than three fragments, or where all are alike.
class Locality : public Metric {
 public:
  MetricInfo info() const override;
  Measurement measure(const CellResult& cell) const override;
};

}  // namespace fracbench
