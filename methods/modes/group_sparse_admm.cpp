#include "methods/modes/group_sparse_admm.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/sum.h"
#include "methods/modes/anderson.h"
#include "methods/modes/round_to_pieces.h"

namespace fracbench::modes {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The Frobenius norm of every group of g rows.
VectorXd group_norms(const MatrixXd& field, int g) {
  if (g == 1 && field.cols() == 1) return field.cwiseAbs();
  VectorXd norms(field.rows() / g);
  for (Eigen::Index f = 0; f < norms.size(); ++f) norms[f] = field.middleRows(g * f, g).norm();
  return norms;
}

/// The proximal map of sum of threshold_f |t_f|.
MatrixXd shrink(const MatrixXd& t, const VectorXd& thresholds, int g) {
  if (g == 1 && t.cols() == 1) {
    return t.col(0) - t.col(0).cwiseMax(-thresholds).cwiseMin(thresholds);
  }
  MatrixXd z(t.rows(), t.cols());
  for (Eigen::Index f = 0; f < thresholds.size(); ++f) {
    const double norm = t.middleRows(g * f, g).norm();
    const double factor = norm > thresholds[f] ? 1 - thresholds[f] / norm : 0;
    z.middleRows(g * f, g) = factor * t.middleRows(g * f, g);
  }
  return z;
}

double dot(const MatrixXd& a, const MatrixXd& b) { return a.cwiseProduct(b).sum(); }

double quadratic_form(const GroupSparseEnergy& energy, const MatrixXd& u) {
  return energy.quadratic.nonZeros() == 0 ? 0 : dot(u, energy.quadratic * u);
}

}  // namespace

double GroupSparseEnergy::value(const MatrixXd& u) const {
  Sum sum;
  const VectorXd norms = group_norms(jump * u, group_rows);
  for (Eigen::Index f = 0; f < norms.size(); ++f) sum += weights[f] * norms[f];
  return sum.value() + quadratic_form(*this, u) / 2;
}

GroupSparseSolver::GroupSparseSolver(const GroupSparseEnergy& energy, int components)
    : energy_(energy),
      components_(components),
      jump_rows_(energy.jump),
      jump_columns_(energy.jump.transpose()),
      mass_kernel_(energy.mass * energy.kernel),
      orthogonal_(energy.size() * components, 0) {
  jump_square_ = energy.jump.transpose() * energy.jump;
  // A multiple of the unit matrix on the grounded rows makes the matrix regular, and changes no
  // solution for a right side that is orthogonal to the kernel but by an element of the kernel.
  const double scale = jump_square_.diagonal().mean();
  Eigen::SparseMatrix<double> ground(energy.size(), energy.size());
  for (const std::int32_t row : energy.grounded) ground.coeffRef(row, row) += scale;
  jump_square_ += ground;
}

void GroupSparseSolver::factor(double penalty) {
  // Without Q the matrix is a multiple of D^T D, and one factor serves every penalty.
  const bool scaled = energy_.quadratic.nonZeros() == 0;
  if (scaled ? factored_penalty_ != 0 : factored_penalty_ == penalty) return;
  cholesky_.factor(scaled
                       ? jump_square_
                       : Eigen::SparseMatrix<double>(energy_.quadratic + penalty * jump_square_));
  factored_penalty_ = scaled ? 1 : penalty;
}

void GroupSparseSolver::solve_in_place(Eigen::Ref<MatrixXd> right, double penalty) {
  factor(penalty);
  cholesky_.solve(right);
  if (factored_penalty_ != penalty) right *= factored_penalty_ / penalty;
  right -= energy_.kernel * (mass_kernel_.transpose() * right);
}

MatrixXd GroupSparseSolver::solve(MatrixXd right, double penalty) {
  solve_in_place(right, penalty);
  return right;
}

MatrixXd GroupSparseSolver::responses(const MatrixXd& constraints, double penalty) {
  MatrixXd result = constraints;
  Eigen::Map<MatrixXd> columns(result.data(), energy_.size(), components_ * constraints.cols());
  solve_in_place(columns, penalty);
  return result;
}

void GroupSparseSolver::add_orthogonal(const MatrixXd& a) {
  orthogonal_.conservativeResize(Eigen::NoChange, orthogonal_.cols() + 1);
  orthogonal_.rightCols(1) = a.reshaped();
  if (response_penalty_ == 0) return;
  responses_.conservativeResize(orthogonal_.rows(), orthogonal_.cols());
  responses_.rightCols(1) = responses(orthogonal_.rightCols(1), response_penalty_);
}

/// One minimisation.
struct GroupSparseSolver::Run {
  GroupSparseSolver& solver;
  const GroupSparseEnergy& energy;
  const AdmmOptions& options;
  MatrixXd constraints = {};  ///< N c x k, the normalisation last
  double rho = 0;

  MatrixXd response = {};            ///< of the constraints at rho
  Eigen::LDLT<MatrixXd> schur = {};  ///< constraints^T response
  VectorXd thresholds = {};          ///< weights / rho
  MatrixXd u = {}, du = {}, z = {};  ///< of the last step
  VectorXd multipliers = {};

  void set_penalty(double penalty) {
    rho = penalty;
    const Eigen::Index k = constraints.cols();
    if (solver.response_penalty_ != rho) {
      const bool scaled = energy.quadratic.nonZeros() == 0 && solver.response_penalty_ != 0;
      if (scaled) {
        solver.responses_ *= solver.response_penalty_ / rho;
      } else {
        solver.responses_ = solver.responses(solver.orthogonal_, rho);
      }
      solver.response_penalty_ = rho;
    }
    response.resize(constraints.rows(), k);
    response.leftCols(k - 1) = solver.responses_;
    response.rightCols(1) = solver.responses(constraints.rightCols(1), rho);
    schur.compute(constraints.transpose() * response);
    thresholds = energy.weights / rho;
  }

  /// One step of the iteration t -> alpha D u + (1 - alpha) z + w with z + w = t.
  MatrixXd step(const MatrixXd& t) {
    z = shrink(t, thresholds, energy.group_rows);
    const MatrixXd pull = rho * (2 * z - t);  // evaluated once: the product reads it often
    MatrixXd right = solver.jump_columns_ * pull;
    solver.solve_in_place(right, rho);
    VectorXd violation = -constraints.transpose() * right.reshaped();
    violation[violation.size() - 1] += 1;
    multipliers = schur.solve(violation);
    right.reshaped() += response * multipliers;
    u = std::move(right);
    du.noalias() = solver.jump_rows_ * u;
    return options.relaxation * du - options.relaxation * z + t;
  }

  /// Largest lower bound that the multiplier y = rho (D u - z + w) gives when it is scaled until no
  /// group exceeds its weight.
  double bound(const MatrixXd& y) const {
    const double excess =
        (group_norms(y, energy.group_rows).array() / energy.weights.array()).maxCoeff();
    const double nu = multipliers[multipliers.size() - 1];
    const double form = quadratic_form(energy, u);
    if (!(nu > 0)) return 0;
    const double scale = form > 0 ? std::min(1 / excess, nu / form) : 1 / excess;
    return scale * nu - scale * scale * form / 2;
  }
};

AdmmResult GroupSparseSolver::minimise(const MatrixXd& c, const AdmmOptions& options,
                                       AdmmState& state, const Context& context) {
  Run run{.solver = *this, .energy = energy_, .options = options};
  run.constraints.resize(orthogonal_.rows(), orthogonal_.cols() + 1);
  run.constraints << orthogonal_, c.reshaped();

  if (state.penalty == 0) {
    // Shrinks jumps that are a hundredth of those of a field with unit mass norm.
    const double mass = energy_.mass.diagonal().sum();
    const double typical = 0.1 * std::sqrt(components_ / mass) *
                           std::sqrt(jump_square_.diagonal().sum() / energy_.groups() / 2);
    state.penalty = energy_.weights.mean() / typical;
  }
  run.set_penalty(state.penalty);
  if (state.split.size() == 0) {
    state.split = MatrixXd::Zero(energy_.jump.rows(), components_);
  }

  AdmmResult result;
  result.energy = std::numeric_limits<double>::infinity();
  Anderson anderson(options.memory);
  MatrixXd& t = state.split;
  MatrixXd z_before;
  for (int i = 1; i <= options.iterations; ++i) {
    MatrixXd next = run.step(t);
    const bool look = i % options.check_every == 0;
    if (look) {
      context.stop_if_asked();
      const MatrixXd y = run.rho * (run.du - 2 * run.z + t);
      const double bound = run.bound(y);
      if (bound > result.bound) {
        result.bound = bound;
        result.dual = y;
        result.smooth = run.u;
        result.multipliers = run.multipliers;
      }
      const auto offer = [&](const MatrixXd& u) {
        const double value = energy_.value(u);
        if (!(value < result.energy)) return;
        result.energy = value;
        result.u = u;
      };
      offer(run.u);
      if (!energy_.joins.empty()) {
        if (const auto rounded = round_to_pieces(energy_, run.u, run.z, run.constraints)) {
          offer(*rounded);
        }
      }
      result.iterations = i;
      const MatrixXd z_next = shrink(next, run.thresholds, energy_.group_rows);
      result.primal_residual = (run.du - z_next).norm() / std::max(run.du.norm(), z_next.norm());
      result.dual_residual = run.rho * (energy_.jump.transpose() * (z_next - run.z)).norm() /
                             (energy_.jump.transpose() * y).norm();
      const bool residuals = result.primal_residual <= options.residual_tolerance &&
                             result.dual_residual <= options.residual_tolerance;
      if (result.gap() <= options.gap_tolerance ||
          (residuals && result.gap() <= 10 * options.gap_tolerance)) {
        result.converged = true;
        t = std::move(next);
        return result;
      }
      const double ratio = result.primal_residual / result.dual_residual;
      const bool settled = i > 1000 && i % 500 != 0;
      if (!settled && (ratio > 5 || ratio < 0.2) && i % (5 * options.check_every) == 0) {
        const double factor = std::clamp(std::sqrt(ratio), 0.2, 5.0);
        const MatrixXd z = shrink(next, run.thresholds, energy_.group_rows);
        t = z + (next - z) / factor;
        run.set_penalty(run.rho * factor);
        state.penalty = run.rho;
        anderson.reset();
        continue;
      }
    }
    anderson.advance(t, std::move(next));
  }
  throw MethodFailure(fmt::format(
      "a fracture mode did not converge in {} ADMM iterations (gap {:.1e}, primal residual {:.1e}, "
      "dual residual {:.1e}); raise residual_tolerance or use fewer tets",
      options.iterations, result.gap(), result.primal_residual, result.dual_residual));
}

}  // namespace fracbench::modes
