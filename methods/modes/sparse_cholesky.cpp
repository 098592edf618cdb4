#include "methods/modes/sparse_cholesky.h"

#include <cholmod.h>
#include <fmt/format.h>

#include "core/error.h"

namespace fracbench::modes {

struct SparseCholesky::State {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  // Kept between calls, so that a solution allocates nothing.
  cholmod_dense* solution = nullptr;
  cholmod_dense* work_1 = nullptr;
  cholmod_dense* work_2 = nullptr;

  State() {
    cholmod_start(&common);
    common.print = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_METIS;
    common.postorder = 1;
    common.final_ll = 1;
    // Supernodes pay for large fill only: solutions with the small ones of tet meshes take ten
    // times as long through the BLAS.
    common.supernodal = CHOLMOD_AUTO;
    common.supernodal_switch = 400;
  }
  ~State() {
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&work_1, &common);
    cholmod_free_dense(&work_2, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
};

SparseCholesky::SparseCholesky() : state_(std::make_unique<State>()) {}
SparseCholesky::~SparseCholesky() = default;

void SparseCholesky::factor(const Eigen::SparseMatrix<double>& matrix) {
  Eigen::SparseMatrix<double> lower = matrix.triangularView<Eigen::Lower>();
  lower.makeCompressed();
  cholmod_sparse view{};
  view.nrow = lower.rows();
  view.ncol = lower.cols();
  view.nzmax = lower.nonZeros();
  view.p = lower.outerIndexPtr();
  view.i = lower.innerIndexPtr();
  view.x = lower.valuePtr();
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  if (!state_->factor) state_->factor = cholmod_analyze(&view, &state_->common);
  if (state_->factor) cholmod_factorize(&view, state_->factor, &state_->common);
  if (state_->common.status == CHOLMOD_OUT_OF_MEMORY) {
    throw MethodFailure("sparse Cholesky factorisation: out of memory; ask for fewer tets");
  }
  if (!state_->factor || state_->common.status != CHOLMOD_OK) {
    throw MethodFailure(fmt::format(
        "sparse Cholesky factorisation: the matrix is not positive definite (column {} of {}); the "
        "tets are badly shaped, or the material's values far apart",
        state_->factor ? state_->factor->minor : 0, lower.cols()));
  }
}

void SparseCholesky::solve(Eigen::Ref<Eigen::MatrixXd> right) const {
  if (right.size() == 0) return;
  State& state = *state_;
  cholmod_dense view{};
  view.nrow = right.rows();
  view.ncol = right.cols();
  view.nzmax = right.outerStride() * right.cols();
  view.d = right.outerStride();
  view.x = right.data();
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_solve2(CHOLMOD_A, state.factor, &view, nullptr, &state.solution, nullptr,
                      &state.work_1, &state.work_2, &state.common)) {
    throw MethodFailure("sparse Cholesky solution: out of memory");
  }
  right = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(state.solution->x),
                                            right.rows(), right.cols());
}

Eigen::Index SparseCholesky::size() const { return static_cast<Eigen::Index>(state_->factor->n); }

double SparseCholesky::factor_size() const {
  return state_->factor->is_super ? static_cast<double>(state_->factor->xsize)
                                  : static_cast<double>(state_->factor->nzmax);
}

}  // namespace fracbench::modes
