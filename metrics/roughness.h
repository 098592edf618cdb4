#pragma once

#include "metrics/metric.h"

namespace fracbench {

/// `roughness`: how far the fracture surface is from being made of planar cuts. A patch is the
/// faces of one fragment that belong to one interface; its best-fit plane is the one with the least
/// integral of the squared distance over the patch (through its centroid, across the eigenvector of
/// the smallest eigenvalue of its second moments), with normal p. Over all faces of all patches,
///
///   roughness = sum A angle(n, p) / sum A,   angle in [0, 90] degrees, without regard to sign,
///
/// so that planar cuts give 0. Both sides of a crack are in the sum with their own plane: where
/// they are the same surface, the mean is that of one side. Series `interface_roughness`: the mean
/// angle of each patch, by fragment and number of the interface. `interface_count`: different
/// interfaces. Faces whose interface is not known are left out; without any other there is no
/// value.
class Roughness final : public Metric {
 public:
  MetricInfo info() const override;
  Measurement measure(const CellResult& cell) const override;
};

}  // namespace fracbench
