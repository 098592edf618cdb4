#pragma once

#include <Eigen/Core>

#include "methods/modes/group_sparse_admm.h"

namespace fracbench::modes {

/// The `count` smoothest fields next to the kernel: eigenvectors of Q + rho D^T D with respect to
/// M, of the smallest eigenvalues, M-orthonormal, as columns. D^T D is a finite-volume Laplacian,
/// since its rows are scaled by sqrt(area / distance of the centroids). Throws MethodFailure where
/// the eigenvalue iteration fails.
Eigen::MatrixXd smoothest_fields(const GroupSparseEnergy& energy, GroupSparseSolver& solver,
                                 int count, double penalty);

}  // namespace fracbench::modes
