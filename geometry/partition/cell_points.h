#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace fracbench::partition {

/// A point of an interface in its cell, and the points in the cells beside it that it is connected
/// to.
struct CellPoint {
  Vec3 place = Vec3::Zero();  ///< in the cell, [0, 1]^3
  /// Indices of points, or -1: below and above along x, then y, then z.
  std::array<std::int32_t, 6> neighbours = {-1, -1, -1, -1, -1, -1};
  bool movable = false;
};

/// Smooths interfaces without moving a point out of its cell. First `steps` sweeps of Laplacian
/// smoothing, after which planes are plane, but what is curved has shrunk. What the points moved by
/// is then averaged over twice as many sweeps, so that of it only the shrinkage is left, and given
/// back; two sweeps more even out the points that the cells held back.
void smooth_points(std::vector<CellPoint>& points, int steps, int threads);

}  // namespace fracbench::partition
