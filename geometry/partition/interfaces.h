#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "geometry/partition/label_lattice.h"

namespace fracbench::partition {

/// The triangles between regions, which are numbered from 1 (0: the void), all in one complex with
/// shared vertices. Within the body they do not cross each other; where the complex ends, it ends
/// outside the body.
struct InterfaceComplex {
  TriangleMesh mesh;
  /// Per face: the region that its normal points away from, and the one that it points into.
  std::vector<std::array<std::int32_t, 2>> sides;
};

/// The interfaces between the regions of a lattice.
struct InterfaceMesh : InterfaceComplex {
  /// Per face: the edge of the lattice that it crosses: 8 * (index of its lower sample) + step.
  std::vector<std::int64_t> edge;
  std::size_t ambiguous_cells = 0;
};

struct InterfaceOptions {
  int smoothing_steps = 16;
  bool with_void = false;  ///< also the triangles between a region and the void
  std::uint64_t salt = 0;  ///< other salts displace the vertices differently by a tiny amount
  int threads = 2;
};

/// The surface between the regions, as a dual mesh: a vertex in every cell with several regions, a
/// polygon around every lattice edge whose ends differ. Cells in which that would join what must be
/// apart (a region or union of regions that is not separated from the rest by one disc) are cut
/// into the six tetrahedra of Kuhn's subdivision, with a vertex in each of them and in each of
/// their sides; in that subdivision, nothing is ambiguous. So every region, and every union of
/// regions, is bounded by a manifold.
///
/// No two triangles cross: a polygon is a fan around a point on its lattice edge, or two triangles
/// where these lie within the tetrahedra between that edge and the vertices in the cells around it;
/// such tetrahedra of different edges have no inner point in common as long as the vertices stay in
/// their cells (T. Ju and T. Udeshi, "Intersection-free contouring on an octree grid", 2006).
/// Smoothing keeps them there.
///
/// All vertices are displaced by about 1e-5 of the spacing, so that nothing coincides with the
/// vertices of a mesh.
InterfaceMesh extract_interfaces(const LabelLattice& lattice, const InterfaceOptions& options);

/// Cells that hold the triangles of an interface polygon: calls visit(index of the lowest sample).
template <typename Visit>
void for_each_cell_of_edge(const VoxelGrid<std::int32_t>& grid, std::int64_t edge,
                           const Visit& visit) {
  const int d = static_cast<int>(edge & 7);
  const auto sample = static_cast<std::size_t>(edge >> 3);
  for (int off = 0; off < 8; ++off) {
    if (off & d) continue;
    visit(sample - grid.index(off & 1, off >> 1 & 1, off >> 2 & 1));
  }
}

}  // namespace fracbench::partition
