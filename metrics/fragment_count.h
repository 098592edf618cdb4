#pragma once

#include "metrics/metric.h"

namespace fracbench {

/// The smallest fragment that the paper's segmentation lets through, 50 voxels of its grid of 128^3
/// on the cube [-1, 1]^3, m^3. It scales with the body's longest side, which fills 1.9 of the cube:
///
///   V_min = 50 * (2 / 128 * L / 1.9)^3.
double smallest_counted_volume(const TriangleMesh& body);

/// `fragment_count`: how many fragments there are at the end, the body itself where it did not
/// break. `fragment_count_above_minimum`: those of a volume of at least V_min, so that methods of
/// different resolution can be compared. `minimum_volume_fraction`: V_min over the body's volume.
/// All pure numbers.
class FragmentCount final : public Metric {
 public:
  MetricInfo info() const override;
  Measurement measure(const CellResult& cell) const override;
};

}  // namespace fracbench
