#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.h"
#include "geometry/measures.h"

namespace fracbench::cvd {

/// The Voronoi diagram of a set of sites within a box around a body, as incidences only: where its
/// corners lie follows from the sites.
struct VoronoiCells {
  /// A corner, equally far from four sites (ascending).
  struct Vertex {
    std::array<std::int32_t, 4> sites;
  };
  /// An edge, equally far from three sites (ascending), directed along
  /// (p_j - p_i) x (p_k - p_i). Ends are vertices; -1: it leaves the box.
  struct Edge {
    std::array<std::int32_t, 3> sites;
    std::int32_t start = -1;
    std::int32_t end = -1;
  };

  std::vector<Vec3> sites;
  std::vector<std::vector<std::int32_t>> neighbours;  ///< of each cell, ascending
  std::vector<Vertex> vertices;                       ///< ascending by sites
  std::vector<Edge> edges;                            ///< ascending by sites
};

/// Cells computed by Voro++ (Rycroft, "Voro++: a three-dimensional Voronoi cell library in C++",
/// Chaos 19, 2009) and verified: the cells must agree with each other, and each edge's two corners
/// must satisfy the empty-sphere condition, decided with error bounds. Throws Degenerate where that
/// is not so (five sites on a sphere, for instance). Needs one site at least, all different.
VoronoiCells voronoi_cells(std::span<const Vec3> sites, const BoundingBox& body);

}  // namespace fracbench::cvd
