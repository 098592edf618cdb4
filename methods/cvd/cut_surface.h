#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "methods/cvd/surface_topology.h"
#include "methods/cvd/voronoi_cells.h"

namespace fracbench::cvd {

/// A vertex that the cut creates on the body's surface.
struct SurfaceVertex {
  std::int32_t place = -1;                        ///< mesh edge, or mesh face
  std::array<std::int32_t, 3> sites{-1, -1, -1};  ///< two at an edge, three in a face; ascending
  bool operator==(const SurfaceVertex&) const = default;
  bool on_edge() const { return sites[2] < 0; }
};

/// The body's surface divided by the cells: a convex polygon per face and cell.
struct SurfaceCut {
  struct Polygon {
    std::int32_t face = -1;
    std::int32_t cell = -1;
    std::int32_t first = 0;  ///< into corners and lines
    std::int32_t size = 0;
  };
  std::vector<std::int32_t> owner;  ///< the cell that each mesh vertex lies in
  std::vector<Polygon> polygons;    ///< ascending by face; whole faces are polygons of size 3
  std::vector<std::int32_t> corners;
  /// What bounds the polygon from each corner to the next: the cell beyond, or -1: a mesh edge.
  std::vector<std::int32_t> lines;
  std::vector<SurfaceVertex> vertices;  ///< numbered from the number of mesh vertices on
};

/// Throws Degenerate.
SurfaceCut cut_surface(const SurfaceTopology& body, const VoronoiCells& cells, int threads);

}  // namespace fracbench::cvd
