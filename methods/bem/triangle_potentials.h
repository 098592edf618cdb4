#pragma once

#include "methods/bem/boundary_elements.h"

namespace fracbench::bem {

/// Integrals over a flat triangle of r / |r|^3 and of r r^T (r . density) / |r|^5, r = x - y from
/// the points y of the triangle to x, and the solid angle: what the gradient of Kelvin's solution
/// needs.
struct TrianglePotentials {
  Vec3 field = Vec3::Zero();  ///< integral of r / |r|^3 (dimensionless)
  Mat3 third = Mat3::Zero();  ///< integral of r r^T (r . density) / |r|^5
  double solid_angle = 0;     ///< integral of n . r / |r|^3, sr; positive on the normal's side
};

/// In closed form, for any x off the triangle's edges. On an edge the integrals are infinite:
/// finite numbers without meaning come back. `normal`: of the triangle, unit.
TrianglePotentials triangle_potentials(const Corners& corners, const Vec3& normal, const Vec3& x,
                                       const Vec3& density);

}  // namespace fracbench::bem
