#pragma once

#include "methods/bem/galerkin_integrals.h"

namespace fracbench::bem {

// Pairs of triangles that share corners. The kernels are homogeneous in x - y (degree -1, and -2
// for the double layer), so that in coordinates whose origin is what the two triangles share, all
// that is singular is integrated in closed form and a smooth integrand over directions is left.

/// Both triangles are the same set of points: closed form. The double layer is zero.
PairIntegrals coincident_pair(const Corners& corners);

/// The triangles share their corners 0 and 1 (in this order in both) and nothing else. `normal` is
/// the trial triangle's; corner k of the results' double layer is corner k of `trial`.
PairIntegrals edge_pair(const Corners& test, const Corners& trial, const Vec3& normal);

/// The triangles share their corner 0 and nothing else.
PairIntegrals vertex_pair(const Corners& test, const Corners& trial, const Vec3& normal);

}  // namespace fracbench::bem
