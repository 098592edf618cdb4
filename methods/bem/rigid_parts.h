#pragma once

#include <Eigen/Core>

#include "methods/bem/cracked_surface.h"

namespace fracbench::bem {

/// The motions of a cracked body that strain nothing, as orthonormal columns: six for each part
/// that its cracks separate (one part, as long as every crack has a front). Rows: three for each
/// vertex of the surface, then three for each vertex inside a sheet (lower minus upper side), sheet
/// by sheet.
Eigen::MatrixXd rigid_motions(const CrackedSurface& body);

}  // namespace fracbench::bem
