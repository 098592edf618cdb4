#pragma once

#include <Eigen/Core>
#include <span>

#include "core/context.h"
#include "core/material.h"
#include "methods/bem/boundary_elements.h"

namespace fracbench::bem {

// The boundary operators of linear elasticity in Galerkin form, after Kupradze and Maue: with
// displacements linear on flat triangles their surface curls are constant there, and every entry
// comes from weakly singular integrals over pairs of triangles (galerkin_integrals.h).
// O. Steinbach, Numerical Approximation Methods for Elliptic Boundary Value Problems (2008), 6.7;
// G. Of, O. Steinbach, W. L. Wendland, Computing 2005.
//
// Sign convention. With the outward normal, a body with displacement u and traction t on its
// surface satisfies <D u, v> = 1/2 <t, v> - <t, K v>. A crack is a sheet of triangles whose normals
// point from its lower side to its upper one, with the unknown (lower minus upper displacement),
// that is minus its opening, and no tractions on its faces. In one system for body and cracks
// together:
//   [ D_bb  D_bc ] [    u     ]   [ 1/2 <t, v_b> - <t, K v_b> ]
//   [ D_cb  D_cc ] [ -opening ] = [             - <t, K v_c> ]
// and for cracks alone in an infinite body under the far stress sigma:
//   D_cc opening = integral of (sigma n) . v_c.

/// Throws InputError unless Young's modulus > 0, -1 < Poisson's ratio < 0.5 and density > 0, all
/// finite, naming the value.
void check_elastic_material(const Material& material);

/// Lame's second parameter mu = E / (2 (1 + nu)), Pa.
double shear_modulus(const Material& material);

/// The hypersingular operator <D u, v> for v on `test` and u on `trial`, N/m: unknowns of `test` x
/// unknowns of `trial`. Triangles of the two may share corners (by coordinates) or touch. The same
/// bytes for any context.threads.
Eigen::MatrixXd assemble_hypersingular(const BoundaryElements& test, const BoundaryElements& trial,
                                       const Material& material, const Context& context);

/// The same with both equal: each pair of triangles is integrated once, the result is symmetric to
/// the last bit. Both triangles of the matrix are filled.
Eigen::MatrixXd assemble_hypersingular(const BoundaryElements& elements, const Material& material,
                                       const Context& context);

/// <t, K v> for every hat function v of `target` (N; one number for each unknown of `target`),
/// where t is constant on each triangle of `source` (Pa, 3 x triangles) and K is the double layer
/// operator over `target`: what tractions on `source` do on `target`. Triangles of `source` without
/// traction cost nothing.
Eigen::VectorXd apply_adjoint_double_layer(const BoundaryElements& source,
                                           const Eigen::Matrix3Xd& tractions,
                                           const BoundaryElements& target, const Material& material,
                                           const Context& context);

/// <t, v> for every hat function v (N), t constant on each triangle (Pa, 3 x triangles).
Eigen::VectorXd traction_moments(const BoundaryElements& elements,
                                 const Eigen::Matrix3Xd& tractions);

}  // namespace fracbench::bem
