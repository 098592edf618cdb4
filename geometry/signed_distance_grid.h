#pragma once

#include "core/triangle_mesh.h"
#include "core/voxel_grid.h"

namespace fracbench {

/// Fills the grid's values with the signed distance to a closed mesh: positive inside, negative
/// outside, exact to float rounding, sign included, at every sample. The same bytes for any number
/// of threads.
VoxelGrid<float> signed_distance_grid(const TriangleMesh& mesh, VoxelGrid<float> grid,
                                      int threads = 2);

}  // namespace fracbench
