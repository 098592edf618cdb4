#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/triangle_mesh.h"
#include "methods/cvd/surface_topology.h"
#include "methods/cvd/voronoi_cells.h"

namespace fracbench::cvd {

/// A triangle of the body's surface within one cell.
struct SurfaceTriangle {
  Face corners;
  std::int32_t cell = -1;
  std::int32_t parent_face = -1;
};

/// A triangle between two cells, outward for cells[0], inward for cells[1].
struct CrackTriangle {
  Face corners;
  std::array<std::int32_t, 2> cells{-1, -1};
};

/// A body divided into cells, as one complex whose vertices are shared by all cells: a cell's
/// triangles close without gaps, and neighbours have the same triangles between them.
struct CellComplex {
  std::vector<Vec3> vertices;  ///< the mesh's own first, bit for bit
  /// The cells that meet at each vertex, ascending; -1 fills up.
  std::vector<std::array<std::int32_t, 4>> cells_at;
  std::vector<SurfaceTriangle> surface;  ///< ascending by parent_face
  std::vector<CrackTriangle> cracks;     ///< ascending by cells
  /// Length of the shortest edge that the cut made, m; infinite where there is none.
  double shortest_edge = std::numeric_limits<double>::infinity();
};

/// Cuts a body by Voronoi cells.
///
/// Every vertex that the cut creates has a name of its own: mesh edge and bisector (i, j), mesh
/// face and Voronoi edge (i, j, k), or Voronoi vertex (i, j, k, l). Which of them exist follows
/// from signs of determinants that are decided with error bounds (see predicates.h), so that the
/// complex is consistent, and each is computed once, so that all its users hold the same bits.
/// Throws Degenerate where a sign cannot be decided or rounding would close a gap: then the sites
/// have to be moved by a hair. The same result for any number of threads.
///
/// Vertices are rounded to doubles. Only where the cut makes very short edges can that let faces
/// cross; then the whole complex is searched for crossings, and Degenerate thrown where the body
/// itself has none.
CellComplex cut_by_cells(const SurfaceTopology& body, const VoronoiCells& cells, int threads);

}  // namespace fracbench::cvd
