#pragma once

#include <cstdint>
#include <vector>

#include "core/voxel_grid.h"

// The rules of caged-SDF segmentation, written down one after the other with heaps and repeated
// sweeps, without any thought of speed: what the program's way is compared with.
namespace fracbench::reference {

struct HeapSegmentation {
  VoxelGrid<std::int32_t> markers;  ///< 0 where no extended minimum is
  VoxelGrid<std::int32_t> labels;   ///< 0: dam, never reached or not flooded
};

/// With `inside_only`, voxels with field + cage < 0 do not exist.
HeapSegmentation heap_segmentation(const VoxelGrid<float>& field, float cage, float h,
                                   bool inside_only);

}  // namespace fracbench::reference
