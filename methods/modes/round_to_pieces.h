#pragma once

#include <Eigen/Core>
#include <optional>

#include "methods/modes/group_sparse_admm.h"

namespace fracbench::modes {

/// The field next to `u` in the mass norm that is constant on every set of rows joined by closed
/// groups (those where `split` is zero), moved within such fields so that it satisfies the
/// constraints: constraints^T u = (0, ..., 0, 1). None where no such field does.
std::optional<Eigen::MatrixXd> round_to_pieces(const GroupSparseEnergy& energy,
                                               const Eigen::MatrixXd& u,
                                               const Eigen::MatrixXd& split,
                                               const Eigen::MatrixXd& constraints);

}  // namespace fracbench::modes
