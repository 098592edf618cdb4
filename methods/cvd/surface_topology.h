#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "geometry/measures.h"

namespace fracbench::cvd {

/// A closed mesh with its edges numbered: what every cut of one body needs, computed once.
struct SurfaceTopology {
  TriangleMesh mesh;
  /// Ends of each edge, the lower index first.
  std::vector<std::array<std::int32_t, 2>> edges;
  /// Edges of each face; edge m goes from corner m to corner m + 1.
  std::vector<std::array<std::int32_t, 3>> face_edges;
  BoundingBox box;
  double volume = 0;  ///< m^3
  /// What the rounding of coordinates is in proportion to: the largest coordinate or the longest
  /// side of the box, m.
  double scale = 0;
};

/// Throws MethodFailure, naming the edge, where the mesh is not closed, not manifold along an edge
/// or not consistently oriented, where a face repeats a vertex, or where the volume is not
/// positive. Indices must be in range.
SurfaceTopology surface_topology(const TriangleMesh& mesh);

}  // namespace fracbench::cvd
