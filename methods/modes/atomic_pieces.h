#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/modes/cut_body.h"
#include "methods/modes/fracture_modes.h"
#include "methods/modes/tet_mesh.h"

namespace fracbench::modes {

/// The atomic piece of each tet: tets that share a face are in one where they are in the same piece
/// of every mode. Numbered in the order of their first tets.
std::vector<std::int32_t> common_pieces(const TetMesh& tets,
                                        std::span<const std::vector<std::int32_t>> pieces_by_mode);

/// How the regions move in the modes: column r holds the mean displacements (by volume) of the tets
/// of region r in all modes, that of mode k times sqrt(E_1 / E_k), so that modes of higher energy
/// count less. Without modes, there are no rows.
Eigen::MatrixXd mode_motion(const TetMesh& tets, const FractureModes& modes,
                            std::span<const std::int32_t> region_of_tet);

struct MergeOptions {
  double minimum_volume = 0;  ///< m^3
  std::int32_t wanted = 0;    ///< at most so many pieces; 0: as many as there are
};

/// For each cell of a cut body the piece that it becomes a part of; numbered by their first cells.
/// First cells below the minimum volume join the neighbour with which they share the largest area,
/// smallest first. Then, while there are more pieces than wanted, the two neighbours a, b are
/// joined whose motions x differ least:
///     V_a V_b / (V_a + V_b) |x_a - x_b|^2,
/// which is what the modes' (weighted) mass norm loses (Ward's method); V is their volume. So
/// small pieces and pieces that hardly part in any mode of low energy go first. Cells without
/// neighbours stay.
std::vector<std::int32_t> merge_cells(const CutBody& cut, const Eigen::MatrixXd& motion,
                                      const MergeOptions& options);

/// A share of a region's volume that a piece takes.
struct RegionShare {
  std::int32_t region = -1;
  double volume = 0;  ///< m^3, inside the body
};

/// The body cut into its pieces for good.
struct AtomicPieces {
  CutBody cut;                                    ///< its cells are the pieces
  std::vector<std::int32_t> region_of_tet;        ///< the regions that the pieces are made of
  std::vector<std::vector<RegionShare>> regions;  ///< per piece, by ascending region
};

/// Cuts the body by the atomic pieces of the modes and merges these; regions that only become parts
/// of a larger piece leave no trace in the surface, as the cut is made again without them. Throws
/// as cut_body.
AtomicPieces atomic_pieces(const TriangleMesh& body, const TetMesh& tets,
                           const FractureModes& modes, const MergeOptions& options,
                           Context& context);

}  // namespace fracbench::modes
