#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "methods/cvd/cut_surface.h"
#include "methods/cvd/triangulate.h"

namespace fracbench::cvd {

/// The outline of the crack between two cells: the body's part of their common Voronoi face,
/// counter-clockwise seen from cells[1] (from outside cells[0]).
struct CrackOutline {
  std::array<std::int32_t, 2> cells;
  std::vector<BoundaryEdge> edges;
};

/// All crack outlines, ascending by cells, and the Voronoi vertices within the body, whose numbers
/// follow those of the surface cut.
struct CrackOutlines {
  std::vector<CrackOutline> outlines;
  std::vector<std::int32_t> inner_vertices;  ///< into VoronoiCells::vertices
};

/// Puts together the outlines: on the surface from the polygons' lines, within the body from the
/// parts of the Voronoi edges between their crossings with the surface. `vertices` are the
/// positions of the mesh's and the surface cut's vertices. Throws Degenerate.
CrackOutlines crack_outlines(const SurfaceTopology& body, const VoronoiCells& cells,
                             const SurfaceCut& surface, const std::vector<Vec3>& vertices);

}  // namespace fracbench::cvd
