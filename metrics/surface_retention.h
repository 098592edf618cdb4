#pragma once

#include "metrics/metric.h"

namespace fracbench {

/// How far a tagged face may be from the body's face that it names, over the body's longest side.
inline constexpr double kRetentionTolerance = 1e-6;

/// How much of the body's surface the fragments still carry.
///
/// `surface_retention` = sum of A over retained faces / area of the body, a pure number. A face is
/// retained when it is tagged original and truly lies on the face that it names: its corners and
/// its centroid are within the tolerance of that triangle, and it looks the same way (a face
/// thinner than the tolerance has no reliable normal and need not). 1 for a method that keeps the
/// surface; above 1 where parts of it are there twice.
///
/// `surface_distance`: the largest distance, m, of corners and centroids of the faces tagged
/// original to the body's surface, and of the body's vertices to the nearest fragment's surface
/// (fracture surface included): a Hausdorff distance of samples, both ways. The first part does not
/// exist where no face is tagged.
class SurfaceRetention final : public Metric {
 public:
  MetricInfo info() const override;
  Measurement measure(const CellResult& cell) const override;
};

}  // namespace fracbench
