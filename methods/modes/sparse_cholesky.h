#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace fracbench::modes {

/// Cholesky factorisation of a sparse symmetric positive definite matrix (CHOLMOD, nested
/// dissection), for many solutions with one matrix or with several of one pattern.
class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  /// The lower triangle of `matrix` is read. A matrix of the pattern of the last one keeps its
  /// ordering. Throws MethodFailure where the matrix is not positive definite or memory runs out.
  void factor(const Eigen::SparseMatrix<double>& matrix);

  /// The solutions of matrix * x = right, column by column, in place.
  void solve(Eigen::Ref<Eigen::MatrixXd> right) const;

  Eigen::Index size() const;
  /// Numbers in the factor.
  double factor_size() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace fracbench::modes
