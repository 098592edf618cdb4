#pragma once

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/triangle_mesh.h"
#include "geometry/partition/interfaces.h"
#include "geometry/partition/label_lattice.h"

namespace fracbench::partition {

/// Body and interfaces are not in general position, or rounding broke the order of crossings: try
/// again with another displacement of the interfaces.
class NotGeneric : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A point where an edge of one mesh goes through a face of the other.
struct Crossing {
  bool body_edge = false;     ///< edge of the body and face of the interfaces; else the reverse
  std::int32_t a = 0, b = 0;  ///< the edge's vertices, a < b
  std::int32_t face = 0;
  Vec3 position = Vec3::Zero();
};

/// Where a body's face and an interface's face meet. It runs along (normal of the body's face) x
/// (normal of the interface's face): seen along the body's normal, what lies behind the interface
/// is on its left; seen along the interface's normal, the outside of the body is on its left.
struct CutSegment {
  std::int32_t body_face = 0;
  std::int32_t interface_face = 0;
  std::int32_t from = 0, to = 0;  ///< indices into `crossings`
};

/// All crossings of a body with interfaces. Signs come from exact predicates; a coordinate is
/// computed with 113 bits and rounded once.
struct Crossings {
  std::vector<Crossing> crossings;   ///< those on one edge are neighbours, ordered from a to b
  std::vector<CutSegment> segments;  ///< by ascending (body_face, interface_face)

  /// The range of indices of the crossings on an edge.
  std::pair<std::int32_t, std::int32_t> on_edge(bool body_edge, std::int32_t a,
                                                std::int32_t b) const;
};

/// Throws NotGeneric.
Crossings find_crossings(const TriangleMesh& body, const InterfaceMesh& interfaces,
                         const VoxelGrid<std::int32_t>& grid, int threads);

/// The same for triangles that come from no lattice, slower. Throws NotGeneric.
Crossings find_crossings(const TriangleMesh& body, const TriangleMesh& interfaces, int threads);

}  // namespace fracbench::partition
