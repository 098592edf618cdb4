#pragma once

#include "metrics/metric.h"

namespace fracbench {

/// How far a tagged face may be from the body's surface, over the body's longest side: coordinates
/// that were written with six digits are within it.
inline constexpr double kRetentionTolerance = 1e-5;

/// How much of the body's surface the fragments still carry.
///
/// `surface_retention` = sum of A over retained faces / area of the body, a pure number. A face is
/// retained when it is tagged original and truly lies on the body's surface: its corners, its
/// centroid and the middles of its edges are within the tolerance of the face that it names (else
/// of any face, since flat parts may be divided anew), and it looks the same way (a face thinner
/// than the tolerance has no reliable normal and need not). 1 for a method that keeps the surface;
/// above 1 where parts of it are there twice.
///
/// `surface_distance`: the largest distance, m, of these samples of faces tagged original to the
/// body's surface, and of the body's vertices to the nearest fragment's surface (fracture surface
/// included): a Hausdorff distance of samples, both ways. The first part does not exist where no
/// face is tagged.
class SurfaceRetention final : public Metric {
 public:
  MetricInfo info() const override;
  Measurement measure(const CellResult& cell) const override;
};

}  // namespace fracbench
