#pragma once

#include <cstdint>
#include <vector>

#include "core/breakable.h"
#include "core/triangle_mesh.h"
#include "core/voxel_grid.h"

namespace fracbench {

enum class PartitionPath {
  fast,  ///< the original surface is cut once along all interfaces
  exact  ///< one CGAL corefinement per label: slower, the reference for `fast`
};

struct PartitionOptions {
  PartitionPath path = PartitionPath::fast;
  /// Sweeps of Laplacian smoothing over the interfaces. No vertex ever leaves its voxel-sized cell.
  /// With 16, the normals of a planar cut deviate by less than 3 degrees on average at every
  /// orientation; more make planes smoother still, but flatten what is curved.
  int smoothing_steps = 16;
  /// Connected parts of less than this many voxels (times spacing^3: the volume) are merged into
  /// the neighbour with which they share the largest area. `fast` only; 0: none.
  double minimum_voxels = 0.5;
  int threads = 2;
};

/// What the grid could not resolve, and what was done about it.
struct PartitionReport {
  std::vector<std::int32_t> piece_label;  ///< per piece
  /// Labels whose region inside the mesh has several connected parts: each is a piece.
  std::vector<std::int32_t> split_labels;
  /// Labels that are in the grid but own no piece: no voxel inside the mesh, or merged away.
  std::vector<std::int32_t> labels_without_piece;
  std::size_t merged_parts = 0;      ///< parts below the minimum that went to a neighbour
  double merged_volume = 0;          ///< their volume, m^3
  std::size_t small_parts_kept = 0;  ///< parts below the minimum that touch no other part
  std::size_t filled_voxels = 0;     ///< voxels inside the mesh without a label
  std::size_t ambiguous_cells = 0;   ///< cells that had to be cut into tetrahedra
  std::size_t interface_faces = 0;   ///< triangles of the interfaces before the cut
  int attempts = 1;                  ///< placements of the interfaces tried (generic position)
};

struct Partition {
  std::vector<Piece> pieces;  ///< by ascending label
  PartitionReport report;
};

/// Cuts the solid `mesh` into the regions of a label volume: values above 0 are labels, all others
/// mean "no label". Voxels inside the mesh and near its surface that have no label take the nearest
/// one. The interfaces between labels are extracted once, as one complex of triangles in which
/// neighbouring regions share their vertices, and smoothed within the cells of the grid; so the
/// pieces fill the mesh exactly, and carry the whole original surface with its vertices bit for
/// bit.
///
/// `mesh` must be closed and free of self-intersections (see require_solid; only closedness is
/// tested here). Throws InputError where the mesh is not closed or not inside the grid, where the
/// grid is not valid, and where no label has a voxel in the mesh; MethodFailure where no attempt
/// gives a valid cut (never seen).
/// The same bytes for any number of threads.
Partition partition_by_labels(const TriangleMesh& mesh, const VoxelGrid<std::int32_t>& labels,
                              const PartitionOptions& options = {});

}  // namespace fracbench
