#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/context.h"
#include "core/triangle_mesh.h"
#include "methods/modes/tet_mesh.h"

namespace fracbench::modes {

/// A body cut once along all interfaces between regions of tets, as one complex of triangles: the
/// boundary of any union of cells is the surface parts of these cells and the interface parts with
/// a cell of the union on one side only.
struct CutBody {
  struct SurfacePart {
    Face corners;
    std::int32_t cell = -1;    ///< that the body has behind it
    std::int32_t source = -1;  ///< face of the body
  };
  struct InterfacePart {
    Face corners;
    std::array<std::int32_t, 2> cells{-1, -1};  ///< the normal points from the first to the second
  };
  /// A connected solid: what of a region lies in the body, where that is connected.
  struct Cell {
    std::int32_t region = -1;
    double volume = 0;  ///< m^3
  };
  std::vector<Vec3> vertices;  ///< the body's first, bit for bit
  /// Per vertex: whether there may be unions of cells that touch themselves there.
  std::vector<std::uint8_t> may_pinch;
  std::vector<SurfacePart> surface;
  std::vector<InterfacePart> interfaces;
  std::vector<Cell> cells;  ///< by ascending region
};

/// Cuts the solid `body` along the faces between tets of different regions (0, 1, ...). The tets
/// must fill a solid around the body, or the body itself. The volumes of the cells add up to that
/// of the body within 1e-10 of it; the same bytes for any number of threads.
/// Throws MethodFailure where no attempt gives a consistent cut.
CutBody cut_body(const TriangleMesh& body, const TetMesh& tets,
                 std::span<const std::int32_t> region_of_tet, Context& context);

/// The same cut with cells joined: `group_of_cell` has numbers 0, 1, ... without gaps, and the
/// cells of a group are connected. Interfaces within a group are dropped.
CutBody join_cells(const CutBody& cut, std::span<const std::int32_t> group_of_cell);

}  // namespace fracbench::modes
