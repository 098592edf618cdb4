#pragma once

#include "core/fragments.h"
#include "core/triangle_mesh.h"
#include "core/voxel_grid.h"

namespace fracbench {

struct GsSdfOptions {
  /// Distances beyond it, on either side, are set to it, m. 0, the published way: none are.
  double truncation = 0;
  int threads = 2;
};

/// The geometrically segmented signed distance function of a fractured body, equation (4) of the
/// DeepFracture paper: at a sample inside a fragment the distance to the nearest surface of any
/// fragment, elsewhere minus the distance to the surface of `original`, m. Exact to float rounding
/// at every sample of the grid. The same bytes for any number of threads.
///
/// The fragments must be closed and are expected to fill the original; where they leave gaps, the
/// field is negative there. Throws InputError where there are no fragments, or the original is
/// empty.
VoxelGrid<float> gs_sdf(const TriangleMesh& original, const Fragments& fragments,
                        VoxelGrid<float> grid, const GsSdfOptions& options = {});

}  // namespace fracbench
