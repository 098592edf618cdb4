#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <vector>

#include "core/context.h"
#include "methods/modes/sparse_cholesky.h"

namespace fracbench::modes {

/// A convex energy of a field u of N values with c components each (an N x c matrix):
///     E(u) = 1/2 tr(u^T Q u) + sum over groups f of weight_f * |(D u)_f|
/// where (D u)_f are the rows g f ... g f + g - 1 of D u and |.| is the Frobenius norm. The groups
/// are the interior faces of a tet mesh and (D u)_f is the jump across one.
struct GroupSparseEnergy {
  Eigen::SparseMatrix<double> jump;       ///< D, (g * groups) x N
  int group_rows = 1;                     ///< g
  Eigen::VectorXd weights;                ///< per group, positive
  Eigen::SparseMatrix<double> quadratic;  ///< Q, N x N, positive semidefinite; may have no entries
  Eigen::SparseMatrix<double> mass;       ///< M, N x N
  /// The fields that cost nothing, Q n = 0 and D n = 0, as columns with N values, M-orthonormal.
  Eigen::MatrixXd kernel;
  /// As many rows as the kernel has columns, on which the kernel is not singular.
  std::vector<std::int32_t> grounded;
  /// Where D u is a difference of two values (g = 1) and M diagonal: the rows of u that a group
  /// joins. A field is then rounded to one that is constant where the groups are closed, which has
  /// a lower energy. Else empty.
  std::vector<std::array<std::int32_t, 2>> joins;

  Eigen::Index size() const { return jump.cols(); }
  Eigen::Index groups() const { return weights.size(); }
  double value(const Eigen::MatrixXd& u) const;
};

struct AdmmOptions {
  double residual_tolerance = 1e-5;  ///< primal and dual, relative
  double gap_tolerance = 1e-5;       ///< of the duality gap, relative to the energy
  int iterations = 20000;            ///< at most
  double relaxation = 1;
  int memory = 20;       ///< fields that Anderson's acceleration looks back at; 0: none
  int check_every = 10;  ///< iterations between two looks at the residuals and the gap
};

/// Where ADMM stands; handed from one problem to the next it saves iterations.
struct AdmmState {
  Eigen::MatrixXd split;  ///< z + w: the copy of D u and its scaled multiplier, in one
  double penalty = 0;     ///< rho; 0: nothing is known yet
};

struct AdmmResult {
  Eigen::MatrixXd u;            ///< N x c; satisfies the constraints to rounding
  Eigen::MatrixXd dual;         ///< y, like D u
  Eigen::MatrixXd smooth;       ///< v: Q v + D^T y = constraints * multipliers, to rounding
  Eigen::VectorXd multipliers;  ///< of the orthogonality constraints and, last, the normalisation
  double energy = 0;            ///< E(u)
  double bound = 0;             ///< no field that satisfies the constraints has less energy
  double primal_residual = 0;   ///< |D v - z| over the larger of |D v|, |z|
  double dual_residual = 0;     ///< change of rho D^T z over |D^T y|
  int iterations = 0;
  bool converged = false;

  double gap() const { return (energy - bound) / energy; }
};

/// Minimises the energy over all u that are M-orthogonal to the kernel, orthogonal to fields a_j,
/// <a_j, u> = 0, and normalised by <c, u> = 1.
///
/// Alternating direction method of multipliers (Boyd et al. 2011) on the splitting z = D u, with
/// over-relaxation, residual balancing of the penalty rho and safeguarded Anderson acceleration. A
/// u-step is one solution with the sparse Cholesky factor of Q + rho D^T D and one with the Schur
/// complement of the constraints, a z-step the shrinkage of every group. It ends where the duality
/// gap is below its tolerance, or both residuals and at most ten times that gap.
class GroupSparseSolver {
 public:
  /// Keeps a reference to `energy`.
  GroupSparseSolver(const GroupSparseEnergy& energy, int components);

  /// Adds the constraint <a, u> = 0. `a` is N x c with kernel^T a = 0.
  void add_orthogonal(const Eigen::MatrixXd& a);

  /// `c` is N x c with kernel^T c = 0. Throws MethodFailure where no field satisfies the
  /// constraints, or the iterations do not suffice.
  AdmmResult minimise(const Eigen::MatrixXd& c, const AdmmOptions& options, AdmmState& state,
                      const Context& context);

  /// The M-orthogonal to the kernel x with (Q + rho D^T D) x = right, for right sides that are
  /// orthogonal to the kernel. Columns are independent.
  Eigen::MatrixXd solve(Eigen::MatrixXd right, double penalty);

 private:
  struct Run;

  void factor(double penalty);
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> right, double penalty);
  Eigen::MatrixXd responses(const Eigen::MatrixXd& constraints, double penalty);

  const GroupSparseEnergy& energy_;
  int components_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> jump_rows_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> jump_columns_;  ///< D^T
  Eigen::SparseMatrix<double> jump_square_;                    ///< D^T D, grounded
  Eigen::MatrixXd mass_kernel_;                                ///< M n
  SparseCholesky cholesky_;
  double factored_penalty_ = 0;  ///< of cholesky_; 0: none
  Eigen::MatrixXd orthogonal_;   ///< N c x j: the fields a_j, component by component
  Eigen::MatrixXd responses_;    ///< their responses at response_penalty_
  double response_penalty_ = 0;
};

}  // namespace fracbench::modes
