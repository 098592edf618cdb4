#pragma once

#include <cstdint>

#include "core/fragments.h"
#include "core/triangle_mesh.h"
#include "core/voxel_grid.h"

namespace fracbench {

/// The closed meshes of all fragments in one, and to which of them each face belongs.
struct FragmentSurfaces {
  TriangleMesh mesh;
  std::vector<std::int32_t> fragment;  ///< parallel to mesh.faces, from 0
};
FragmentSurfaces fragment_surfaces(const Fragments& fragments);

/// In which fragment each sample of the grid lies: 1 for the first one, ..., -1 for none. The
/// fragments must be closed and not overlap (where two do, a sample gets another number); samples
/// on a surface may go either way. The same for any number of threads.
VoxelGrid<std::int32_t> fragment_labels(const Fragments& fragments, VoxelGrid<std::int32_t> grid,
                                        int threads = 2);

}  // namespace fracbench
