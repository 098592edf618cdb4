#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench::cvd {

/// A directed boundary edge, as two vertex numbers; the region lies to its left.
using BoundaryEdge = std::array<std::int32_t, 2>;

/// Triangles of a planar region, and the connected part that each belongs to.
struct PlanarRegion {
  std::vector<Face> triangles;  ///< counter-clockwise about the normal, over the vertex numbers
  std::vector<std::int32_t> part;
  std::int32_t parts = 0;
};

/// Constrained Delaunay triangulation (CGAL) of a region in a plane, of any number of outlines and
/// holes. It sees the vertices along the normal's largest axis, so they may lie off the plane by
/// their rounding. Adds no vertices. Throws Degenerate where the boundary is not a set of closed
/// loops or crosses itself.
PlanarRegion triangulate_region(std::span<const Vec3> vertices,
                                std::span<const BoundaryEdge> boundary, const Vec3& normal);

/// Triangles of a small, nearly planar and nearly convex polygon: ears are cut off by shape, best
/// first, among those that are rightly turned.
std::vector<Face> triangulate_polygon(std::span<const Vec3> vertices,
                                      std::span<const std::int32_t> polygon, const Vec3& normal);

}  // namespace fracbench::cvd
