#include "methods/modes/group_sparse_admm.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/error.h"
#include "methods/modes/modes_problem.h"
#include "methods/modes/smoothest_fields.h"
#include "tests/methods/modes/test_meshes.h"

namespace fracbench::modes {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Everything that certifies an optimum: the field meets the constraints, the multipliers are
/// admissible for the dual problem once scaled, and the two values agree. Nothing here is taken
/// from the solver but the field, the dual field and the multipliers.
struct Certificate {
  double constraint_error = 0;
  double stationarity_error = 0;  ///< of Q v + D^T y = constraints * multipliers
  double primal = 0;
  double dual = 0;
};

Certificate certify(const GroupSparseEnergy& energy, const AdmmResult& result,
                    const std::vector<MatrixXd>& orthogonal, const MatrixXd& c) {
  Certificate certificate;
  const auto note = [&](double error) {
    certificate.constraint_error = std::max(certificate.constraint_error, std::abs(error));
  };
  MatrixXd pull = c * result.multipliers[result.multipliers.size() - 1];
  for (std::size_t j = 0; j < orthogonal.size(); ++j) {
    note(orthogonal[j].cwiseProduct(result.u).sum());
    pull += orthogonal[j] * result.multipliers[static_cast<Eigen::Index>(j)];
  }
  note(c.cwiseProduct(result.u).sum() - 1);
  const MatrixXd along_kernel = energy.kernel.transpose() * (energy.mass * result.u);
  note(along_kernel.cwiseAbs().maxCoeff());
  const MatrixXd left =
      energy.quadratic * result.smooth + energy.jump.transpose() * result.dual - pull;
  certificate.stationarity_error = left.norm() / pull.norm();

  double excess = 0;
  const int g = energy.group_rows;
  for (Eigen::Index f = 0; f < energy.groups(); ++f) {
    excess = std::max(excess, result.dual.middleRows(g * f, g).norm() / energy.weights[f]);
  }
  const double form = result.smooth.cwiseProduct(energy.quadratic * result.smooth).sum();
  const double nu = result.multipliers[result.multipliers.size() - 1];
  const double scale = form > 0 ? std::min(1 / excess, nu / form) : 1 / excess;
  certificate.dual = scale * nu - scale * scale * form / 2;

  for (Eigen::Index f = 0; f < energy.groups(); ++f) {
    certificate.primal += energy.weights[f] * (energy.jump * result.u).middleRows(g * f, g).norm();
  }
  certificate.primal += result.u.cwiseProduct(energy.quadratic * result.u).sum() / 2;
  return certificate;
}

MatrixXd unit_start(const GroupSparseEnergy& energy, GroupSparseSolver& solver, int which) {
  return smoothest_fields(energy, solver, which + 1, 1).col(which);
}

class Surroundings {
 public:
  Context context{.random = random_, .timer = timer_, .progress = progress_};

 private:
  Random random_{1};
  StageTimer timer_;
  Progress progress_;
};

void expect_certified(const Certificate& certificate, double tolerance) {
  EXPECT_LT(certificate.constraint_error, 1e-7);
  EXPECT_LT(certificate.stationarity_error, 1e-7);
  EXPECT_GE(certificate.primal, certificate.dual * (1 - 1e-9));
  EXPECT_LE(certificate.primal - certificate.dual, tolerance * certificate.primal);
}

TEST(GroupSparseAdmm, ClosesTheDualityGapForScalarFields) {
  const GroupSparseEnergy energy = constant_energy(test::tets_of_bar(600));
  Surroundings s;
  GroupSparseSolver solver(energy, 1);
  const MatrixXd fields = smoothest_fields(energy, solver, 3, 1);
  std::vector<MatrixXd> orthogonal;
  for (int k = 0; k < 3; ++k) {
    AdmmState state;
    const MatrixXd c = energy.mass * fields.col(k);
    const AdmmResult result = solver.minimise(c, {.gap_tolerance = 1e-5}, state, s.context);
    expect_certified(certify(energy, result, orthogonal, c), 1e-4);
    EXPECT_NEAR(result.energy, energy.value(result.u), 1e-12);
    orthogonal.push_back(c);
    solver.add_orthogonal(c);
  }
}

TEST(GroupSparseAdmm, ClosesTheDualityGapForVectorFieldsThatPointNowhereInParticular) {
  const GroupSparseEnergy energy = constant_energy(test::tets_of_bar(300));
  Surroundings s;
  GroupSparseSolver solver(energy, 3);
  GroupSparseSolver scalar(energy, 1);
  const MatrixXd fields = smoothest_fields(energy, scalar, 3, 1);
  MatrixXd c = energy.mass * fields;  // every component another field
  c /= std::sqrt(3.0);
  AdmmState state;
  const AdmmResult result = solver.minimise(c, {.gap_tolerance = 5e-5}, state, s.context);
  expect_certified(certify(energy, result, {}, c), 1e-4);
}

TEST(GroupSparseAdmm, GivesVectorProblemsAlongAnAxisTheScalarSolution) {
  // What lets the modes of dimension 3 be computed as those of dimension 1.
  const GroupSparseEnergy energy = constant_energy(test::tets_of_bar(300));
  Surroundings s;
  GroupSparseSolver scalar(energy, 1), vector(energy, 3);
  const VectorXd field = unit_start(energy, scalar, 0);
  MatrixXd c = MatrixXd::Zero(energy.size(), 3);
  c.col(1) = energy.mass * field;
  AdmmState one, three;
  const AdmmResult a =
      scalar.minimise(energy.mass * field, {.gap_tolerance = 1e-6}, one, s.context);
  const AdmmResult b = vector.minimise(c, {.gap_tolerance = 1e-6}, three, s.context);
  EXPECT_NEAR(a.energy, b.energy, 5e-6 * a.energy);
  EXPECT_LT(b.u.col(0).norm() + b.u.col(2).norm(), 1e-6 * b.u.norm());
}

TEST(GroupSparseAdmm, ClosesTheDualityGapForElasticFields) {
  const GroupSparseEnergy energy = elastic_energy(test::tets_of_bar(150), {});
  Surroundings s;
  GroupSparseSolver solver(energy, 1);
  const ElasticScale scale;
  const MatrixXd c =
      energy.mass * smoothest_fields(energy, solver, 1, matching_penalty(scale)).col(0);
  AdmmState state;
  const AdmmResult result = solver.minimise(c, {.gap_tolerance = 1e-4}, state, s.context);
  expect_certified(certify(energy, result, {}, c), 1e-4);
}

TEST(GroupSparseAdmm, SolvesTwoBlocksInClosedForm) {
  // Two tets of volumes 1/6 and 1/3 that share a face of area 1/2: u is fixed by the constraints.
  const TetMesh mesh = make_tet_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -2}},
                                     {{0, 1, 2, 3}, {0, 1, 2, 4}});
  const GroupSparseEnergy energy = constant_energy(mesh);
  Surroundings s;
  GroupSparseSolver solver(energy, 1);
  // Unit mass norm and orthogonal to constants: (2, -1) and 1/6 * 4 + 1/3 * 1 = 1.
  const MatrixXd c = energy.mass * Eigen::Vector2d(2, -1);
  AdmmState state;
  const AdmmResult result = solver.minimise(c, {}, state, s.context);
  EXPECT_NEAR(result.u(0), 2, 1e-9);
  EXPECT_NEAR(result.u(1), -1, 1e-9);
  EXPECT_NEAR(result.energy, 0.5 * 3, 1e-9);
  EXPECT_LE(result.gap(), 1e-5);
}

TEST(GroupSparseAdmm, SaysWhenNoFieldMeetsTheConstraints) {
  const GroupSparseEnergy energy = constant_energy(test::tets_of_bar(300));
  Surroundings s;
  GroupSparseSolver solver(energy, 1);
  const MatrixXd c = energy.mass * unit_start(energy, solver, 0);
  solver.add_orthogonal(c);
  AdmmState state;
  EXPECT_THROW(solver.minimise(c, {.iterations = 200}, state, s.context), MethodFailure);
}

TEST(GroupSparseAdmm, StopsWhenAsked) {
  const GroupSparseEnergy energy = constant_energy(test::tets_of_bar(300));
  Random random(1);
  StageTimer timer;
  Progress progress;
  std::stop_source stop;
  stop.request_stop();
  Context context{.random = random, .timer = timer, .progress = progress, .stop = stop.get_token()};
  GroupSparseSolver solver(energy, 1);
  const MatrixXd c = energy.mass * unit_start(energy, solver, 0);
  AdmmState state;
  EXPECT_THROW(solver.minimise(c, {}, state, context), Cancelled);
}

}  // namespace
}  // namespace fracbench::modes
