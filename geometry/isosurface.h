#pragma once

#include "core/triangle_mesh.h"
#include "core/voxel_grid.h"

namespace fracbench {

/// The surface where the trilinear field crosses `level`, closed and manifold, the side above
/// `level` inside (the field counts as below the level beyond the grid's edge). Topologically
/// consistent on ambiguous cells.
TriangleMesh isosurface(const VoxelGrid<float>& field, float level = 0);

}  // namespace fracbench
