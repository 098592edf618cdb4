#pragma once

#include "core/triangle_mesh.h"

namespace fracbench::bem {

/// The unit cube [0, 1]^3 with `cells` x `cells` squares of two triangles on each side.
TriangleMesh cube_surface(int cells);

/// A sphere around the origin, an icosahedron whose triangles are cut into four `level` times with
/// the new vertices moved onto the sphere: 20 * 4^level triangles.
TriangleMesh sphere_surface(double radius, int level);

/// Both in one mesh: the second, inside the first, turned inside out.
TriangleMesh hollow_surface(const TriangleMesh& outer, const TriangleMesh& inner);

}  // namespace fracbench::bem
