#pragma once

#include <string_view>

#include "core/context.h"
#include "core/triangle_mesh.h"
#include "methods/modes/tet_mesh.h"

namespace fracbench::modes {

struct TetrahedraliseOptions {
  double radius_edge_ratio = 2;  ///< bound of circumradius over shortest edge of every tet, above 1
  double minimum_dihedral = 5;   ///< bound of the dihedral angles, degrees, below 19
  double largest_volume = 0;     ///< of a tet, in units of the surface's frame; 0: any
};

struct Tets {
  std::vector<Vec3> vertices;
  std::vector<Tet> tets;
};

/// Quality tetrahedra of the inside of a closed surface (TetGen, constrained Delaunay refinement).
/// The surface is kept as a set of points; its faces may be divided. Cavities stay empty. Bounds on
/// quality hold but next to small angles of the surface itself.
/// Throws MethodFailure with TetGen's reason and the way out; `name` says whose surface it is.
Tets tetrahedralise(const TriangleMesh& surface, const TetrahedraliseOptions& options,
                    std::string_view name);

}  // namespace fracbench::modes
