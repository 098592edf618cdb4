#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench::bem {

/// An edge of a crack's sheet.
struct SheetEdge {
  std::int32_t a, b;         ///< vertices, a < b
  std::int32_t left, right;  ///< faces; right: -1 on the boundary
  double length;             ///< m
};

/// By their vertices. Throws MethodFailure where more than two triangles share one.
std::vector<SheetEdge> sheet_edges(const TriangleMesh& sheet);

/// Halves the edges inside a sheet that are longer than `longest` (m), the longest first and only
/// where it is the longest of both its triangles, so that they do not become ever thinner (Rivara
/// 1984). Boundary edges stay.
void split_long_edges(TriangleMesh& sheet, double longest);

/// Draws edges inside a sheet that are shorter than `shortest` (m) together, where no triangle
/// turns over or becomes thin on the scale of `size` (m); boundary vertices stay. Vertices that
/// nothing uses any more are left.
void collapse_short_edges(TriangleMesh& sheet, const std::vector<std::uint8_t>& on_boundary,
                          double shortest, double size);

/// Whether vertex `gone` may be drawn to `kept` along their edge: the sheet stays a manifold, no
/// triangle turns over or becomes thin on the scale of `size` (m).
bool may_collapse(const TriangleMesh& sheet, std::int32_t gone, std::int32_t kept, double size);
void collapse_edge(TriangleMesh& sheet, std::int32_t gone, std::int32_t kept);

}  // namespace fracbench::bem
