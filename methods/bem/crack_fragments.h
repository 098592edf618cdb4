#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/breakable.h"
#include "core/context.h"
#include "core/voxel_grid.h"
#include "geometry/partition_by_labels.h"
#include "methods/bem/cut_links.h"

namespace fracbench::bem {

struct FragmentOptions {
  /// Parts of less than this share of the body's volume go to the neighbour with which they share
  /// the most cut links.
  double smallest = 1e-6;
  /// So do parts of less than this many voxels. Where cracks meet at an acute angle they leave
  /// chips that the grid does not resolve.
  double smallest_voxels = 0;
  /// As the authors' program: every fragment is an isosurface of its voxels, so that the original
  /// surface is re-meshed, and fragments of at most `hull_share` of the volume are convex hulls.
  bool parity = false;
  double hull_share = 0.005;
};

struct FragmentReport {
  std::size_t parts = 0;         ///< connected parts of the voxels
  std::size_t merged_parts = 0;  ///< of them too small, given to a neighbour
  double merged_volume = 0;      ///< m^3
  std::size_t separating_cracks = 0;
  /// Cracks of whose cut links less than a fifth lie between fragments: they cut the body but
  /// separate nothing.
  std::size_t cracks_within = 0;
  PartitionReport partition;  ///< not filled under `parity`
};

struct CrackFragments {
  std::vector<Piece> pieces;           ///< one: the cracks did not separate the body
  VoxelGrid<std::int32_t> labels;      ///< 0: outside, else a label
  std::vector<std::int32_t> label_of;  ///< label of every piece
  FragmentReport report;
};

/// The fragments that cracks have made of `body`, the solid that `links` was made from: connected
/// components of its voxels, cut out of the body by partition_by_labels, so that they fill it
/// exactly and keep its surface.
/// The same for any number of threads. Throws MethodFailure where no valid cut is found, Cancelled
/// when asked to stop.
CrackFragments crack_fragments(const TriangleMesh& body, const CutLinks& links,
                               const FragmentOptions& options, const Context& context);

}  // namespace fracbench::bem
