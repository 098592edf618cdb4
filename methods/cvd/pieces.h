#pragma once

#include <cstdint>
#include <vector>

#include "core/breakable.h"
#include "methods/cvd/cut_by_cells.h"

namespace fracbench::cvd {

/// The connected parts of the cells: the smallest units that pieces are made of.
struct CellParts {
  std::vector<std::int32_t> of_surface;  ///< part of each surface triangle
  std::vector<std::array<std::int32_t, 2>>
      of_cracks;                ///< parts on both sides of each crack triangle
  std::vector<double> volumes;  ///< m^3; the parts' number is their count
};

/// Splits cells into connected parts, each with the shells of the cavities within it. Throws
/// Degenerate where a part's volume is not positive or they do not add up to `body_volume` within
/// 1e-10.
CellParts connected_parts(const CellComplex& complex, double body_volume);

/// The piece that each part goes to: parts below `minimum_volume` (m^3) join the neighbour with
/// which they share the largest area, smallest first, until all pieces are large enough or stand
/// alone. Pieces are numbered in the order of their first parts.
std::vector<std::int32_t> merge_small_parts(const CellComplex& complex, const CellParts& parts,
                                            double minimum_volume);

/// The pieces as closed meshes, without faces between parts of one piece. Faces on the surface come
/// first, in the order of the body's.
std::vector<Piece> build_pieces(const CellComplex& complex, const CellParts& parts,
                                const std::vector<std::int32_t>& piece_of_part);

}  // namespace fracbench::cvd
