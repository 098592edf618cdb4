#pragma once

#include <cstdint>
#include <vector>

#include "methods/cvd/predicates.h"
#include "methods/cvd/voronoi_cells.h"

namespace fracbench::cvd {

/// The part of a triangle that lies in one cell: a convex polygon, given by the lines that bound
/// it in the triangle's own sense of rotation. Line -1 - m is the triangle's edge from corner m to
/// corner m + 1, line j >= 0 the bisector between the cell and cell j. Corner n of the polygon is
/// where lines n - 1 and n meet, so it needs no coordinates.
struct ClippedTriangle {
  std::int32_t cell = -1;
  std::vector<std::int32_t> lines;
};

/// All parts of a triangle, for a triangle whose corners lie in the cells `owners`. Each bisector
/// between two parts appears in both. Throws Degenerate.
std::vector<ClippedTriangle> clip_triangle(const VoronoiCells& cells, const Corners& corners,
                                           const std::array<std::int32_t, 3>& owners);

}  // namespace fracbench::cvd
