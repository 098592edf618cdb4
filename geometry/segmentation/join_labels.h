#pragma once

#include <cstdint>
#include <vector>

#include "geometry/segmentation/flood_grid.h"

namespace fracbench {

/// Gives every voxel that is no wall a label, round by round: in each, all voxels without a label
/// that have neighbours with one take the label that most of their six neighbours carry (of equal
/// ones the lowest). What no label reaches stays as it is. Returns how many voxels were given one.
std::int64_t give_dams_to_labels(FloodGrid& grid);

struct JoinedLabels {
  /// By label: the label whose voxels it belongs to in the end (entry 0 is not used).
  std::vector<std::int32_t> target;
  std::int32_t joined = 0;   ///< labels that were given to another one
  std::int32_t islands = 0;  ///< labels below the minimum that have no neighbour, and stay
};

/// Gives every label with `voxels[label] < minimum` to the neighbouring label with which it shares
/// the most voxel faces (of equal ones the lowest), the smallest label first (of equal ones the
/// lowest). The receiver's count grows by what it was given, and may so reach the minimum.
JoinedLabels join_small_labels(const FloodGrid& grid, std::vector<std::int64_t> voxels,
                               std::int64_t minimum);

}  // namespace fracbench
