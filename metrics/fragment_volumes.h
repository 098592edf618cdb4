#pragma once

#include "metrics/metric.h"

namespace fracbench {

/// Volume of the parent that volumes are given in: the paper normalises it to 10.
inline constexpr double kParentVolume = 10;

/// Series `fragment_volume`: v_i = 10 V_i / V_body for each fragment, in the order of the
/// fragments; V is the signed volume of the mesh, negative where it is turned inside out. Values:
/// mean, median, sample standard deviation, largest and smallest of them (`fragment_volume_mean`,
/// ...). Unit: a tenth of the body's volume.
class FragmentVolumes final : public Metric {
 public:
  MetricInfo info() const override;
  Measurement measure(const CellResult& cell) const override;
};

}  // namespace fracbench
