#pragma once

#include <cstdint>
#include <vector>

#include "geometry/segmentation/flood_grid.h"

namespace fracbench {

struct ExtendedMinima {
  std::int32_t count = 0;
  /// All their voxels, in the order in which flooding starts from them: by z, then x, then y.
  std::vector<std::int32_t> voxels;
};

/// Labels the extended minima of the relief with dynamic h, 6-connected: the regional minima of the
/// reconstruction by erosion of height + h over height (Soille, "Morphological Image Analysis",
/// 2003, chapter 6), numbered from 1 in the order in which they are met by z, then y, then x.
/// All voxels that are no walls must be untouched; those that are in no minimum stay so.
///
/// Nothing is reconstructed: the regional minima of that reconstruction are exactly the connected
/// parts C of the sets {height <= min(C) + h}, sums rounded to float, so each is flooded from its
/// lowest voxel. Going through the minima of the relief from low to high, a flood that meets an
/// earlier one is no extended minimum, and no voxel is visited twice.
ExtendedMinima label_extended_minima(FloodGrid& grid, float h, int threads = 1);

}  // namespace fracbench
