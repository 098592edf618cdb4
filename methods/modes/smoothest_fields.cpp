#include "methods/modes/smoothest_fields.h"

#include <Spectra/SymEigsSolver.h>
#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "core/error.h"

namespace fracbench::modes {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// x -> L^T (Q + rho D^T D)^+ L x with M = L L^T; its largest eigenvalues belong to the smoothest
/// fields.
class InverseOperator {
 public:
  using Scalar = double;
  InverseOperator(GroupSparseSolver& solver, const Eigen::SparseMatrix<double>& mass_factor,
                  const MatrixXd& kernel, const MatrixXd& mass_kernel, double penalty)
      : solver_(solver),
        factor_(mass_factor),
        kernel_(kernel),
        mass_kernel_(mass_kernel),
        penalty_(penalty) {}

  Eigen::Index rows() const { return factor_.rows(); }
  Eigen::Index cols() const { return factor_.cols(); }
  void perform_op(const double* in, double* out) const {
    VectorXd x = factor_ * Eigen::Map<const VectorXd>(in, rows());
    x -= mass_kernel_ * (kernel_.transpose() * x);
    Eigen::Map<VectorXd>(out, rows()) =
        factor_.transpose() * VectorXd(solver_.solve(std::move(x), penalty_));
  }

 private:
  GroupSparseSolver& solver_;
  const Eigen::SparseMatrix<double>& factor_;
  const MatrixXd& kernel_;
  const MatrixXd& mass_kernel_;
  double penalty_;
};

}  // namespace

MatrixXd smoothest_fields(const GroupSparseEnergy& energy, GroupSparseSolver& solver, int count,
                          double penalty) {
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>
      mass(energy.mass);
  const Eigen::SparseMatrix<double> factor = mass.matrixL();
  const MatrixXd mass_kernel = energy.mass * energy.kernel;
  InverseOperator inverse(solver, factor, energy.kernel, mass_kernel, penalty);
  const int n = static_cast<int>(energy.size());
  const int lanczos = std::min(n, std::max(2 * count + 20, 3 * count));
  Spectra::SymEigsSolver<InverseOperator> eigenvectors(inverse, count, lanczos);
  eigenvectors.init();  // a fixed start
  eigenvectors.compute(Spectra::SortRule::LargestAlge, 1000, 1e-8);
  if (eigenvectors.info() != Spectra::CompInfo::Successful) {
    throw MethodFailure(
        fmt::format("the {} smoothest displacement fields of {} values were not found; ask for "
                    "fewer modes or more tets",
                    count, n));
  }
  MatrixXd fields = mass.matrixU().solve(eigenvectors.eigenvectors());
  fields -= energy.kernel * (mass_kernel.transpose() * fields);
  return fields;
}

}  // namespace fracbench::modes
