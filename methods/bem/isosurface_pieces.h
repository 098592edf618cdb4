#pragma once

#include <cstdint>
#include <vector>

#include "core/breakable.h"
#include "core/voxel_grid.h"

namespace fracbench::bem {

struct IsosurfacePieces {
  std::vector<Piece> pieces;           ///< by ascending label
  std::vector<std::int32_t> label_of;  ///< parallel to pieces
};

/// Pieces as the authors' program makes them: for each label the isosurface of its smoothed voxels,
/// which re-meshes the original surface and leaves thin gaps; pieces of at most `hull_share` of the
/// body's volume are replaced by their convex hulls. Labels too small for a surface have no piece.
/// A face is tagged with the body's nearest face where no other label lies beyond it.
IsosurfacePieces isosurface_pieces(const TriangleMesh& body, const VoxelGrid<std::int32_t>& labels,
                                   double hull_share, int threads);

}  // namespace fracbench::bem
