#include "methods/modes/round_to_pieces.h"

#include <Eigen/Dense>
#include <cmath>

#include "methods/modes/join.h"

namespace fracbench::modes {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::optional<MatrixXd> round_to_pieces(const GroupSparseEnergy& energy, const MatrixXd& u,
                                        const MatrixXd& split, const MatrixXd& constraints) {
  Joined joined(energy.size());
  for (Eigen::Index f = 0; f < energy.groups(); ++f) {
    if (split.row(f).isZero(0)) joined.join(energy.joins[f][0], energy.joins[f][1]);
  }
  const std::vector<std::int32_t> piece = joined.labels();
  const Eigen::Index pieces = joined.count();
  const Eigen::Index c = u.cols();
  const Eigen::Index k = constraints.cols();
  if (pieces * c < k) return std::nullopt;

  const VectorXd mass = energy.mass.diagonal();
  VectorXd piece_mass = VectorXd::Zero(pieces);
  MatrixXd value = MatrixXd::Zero(pieces, c);
  MatrixXd rows = MatrixXd::Zero(pieces * c, k);  // the constraints on the pieces' values
  for (Eigen::Index i = 0; i < energy.size(); ++i) {
    piece_mass[piece[i]] += mass[i];
    value.row(piece[i]) += mass[i] * u.row(i);
  }
  for (Eigen::Index j = 0; j < k; ++j) {
    for (Eigen::Index d = 0; d < c; ++d) {
      for (Eigen::Index i = 0; i < energy.size(); ++i) {
        rows(d * pieces + piece[i], j) += constraints(d * energy.size() + i, j);
      }
    }
  }
  value.array().colwise() /= piece_mass.array();

  // The smallest change in the mass norm: value += W^-1 rows mu with W the pieces' masses.
  const VectorXd masses = piece_mass.replicate(c, 1);
  const MatrixXd weighted = rows.array().colwise() / masses.array();
  VectorXd violation = -rows.transpose() * value.reshaped();
  violation[k - 1] += 1;
  const VectorXd mu = (rows.transpose() * weighted).ldlt().solve(violation);
  value.reshaped() += weighted * mu;
  MatrixXd result(u.rows(), c);
  for (Eigen::Index i = 0; i < u.rows(); ++i) result.row(i) = value.row(piece[i]);
  result -= energy.kernel * ((energy.mass * energy.kernel).transpose() * result);
  // Too few pieces: a regular system only by rounding.
  VectorXd left = constraints.transpose() * result.reshaped();
  left[k - 1] -= 1;
  if (!(left.cwiseAbs().maxCoeff() < 1e-9)) return std::nullopt;
  return result;
}

}  // namespace fracbench::modes
