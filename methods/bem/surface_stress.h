#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/material.h"
#include "methods/bem/boundary_elements.h"

namespace fracbench::bem {

/// Cauchy stress on each triangle, Pa: the strain in the triangle's plane from the displacements
/// (three per vertex, m) and the traction on it (3 x triangles, Pa) determine all six components.
std::vector<Mat3> surface_stress(const BoundaryElements& elements,
                                 const Eigen::VectorXd& displacements,
                                 const Eigen::Matrix3Xd& tractions, const Material& material);

/// Hooke's law: stress (Pa) of a displacement gradient.
Mat3 stress_of_gradient(const Mat3& gradient, const Material& material);

/// Lame's first parameter lambda = E nu / ((1 + nu) (1 - 2 nu)), Pa.
double lame_lambda(const Material& material);

}  // namespace fracbench::bem
