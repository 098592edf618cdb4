#pragma once

#include "methods/bem/galerkin_integrals.h"

namespace fracbench::bem {

/// The integrals over a pair of triangles by cutting both again and again, with the limit taken by
/// Richardson's extrapolation: parts that touch are similar to the whole, so that what a level
/// lacks are powers of two. Relative error about 1e-7 for ordinary triangles.
PairIntegrals brute_force_pair(const Corners& test, const Corners& trial);

/// Largest difference of the first six values relative to the integral of 1/r.
double single_layer_error(const PairIntegrals& computed, const PairIntegrals& expected);

/// Largest difference of the last three values relative to the integral of 1/r^2 over the pair,
/// taken as (integral of 1/r)^2 / (product of areas).
double double_layer_error(const PairIntegrals& computed, const PairIntegrals& expected,
                          double area_product);

}  // namespace fracbench::bem
