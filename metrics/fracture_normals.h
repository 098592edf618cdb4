#pragma once

#include "metrics/metric.h"

namespace fracbench {

/// How the fracture surfaces lie to the impact. d is the direction of the strongest impulse of the
/// first impact; the sums run over all fracture faces f of all fragments, with area A and unit
/// normal n:
///
///   normal_along  = sum A |n . d| / sum A                  (1/2 for isotropic surfaces)
///   normal_across = sum A |n - (n . d) d| / sum A          (pi/4)
///   fabric_1 >= fabric_2 >= fabric_3: eigenvalues of sum A n n^T / sum A, which add up to 1  (1/3)
///
/// `fracture_area` is sum A / 2, m^2, since each crack has two sides. All others are pure numbers.
/// None of them exists without fracture faces, the first two not without an impact. (The paper
/// plots an "average of fractured surfaces' normal" that it does not define: these are our own
/// definitions. Fabric tensor: Kanatani, "Distribution of directional data and fabric tensors",
/// 1984.)
class FractureNormals final : public Metric {
 public:
  MetricInfo info() const override;
  Measurement measure(const CellResult& cell) const override;
};

}  // namespace fracbench
