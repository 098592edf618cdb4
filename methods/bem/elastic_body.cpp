#include "methods/bem/elastic_body.h"

#include <cblas.h>
#include <fmt/format.h>
#include <lapacke.h>

#include <Eigen/QR>
#include <map>
#include <utility>

#include "core/available_memory.h"
#include "methods/bem/elastic_operator.h"

namespace fracbench::bem {
namespace {

// Every side must belong to two triangles that pass it in opposite directions.
void check_closed(const TriangleMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
  for (const Face& face : mesh.faces) {
    for (int k = 0; k < 3; ++k) ++sides[{face[k], face[(k + 1) % 3]}];
  }
  for (const auto& [side, count] : sides) {
    const auto back = sides.find({side.second, side.first});
    if (count != 1 || back == sides.end() || back->second != 1) {
      throw InputError(
          fmt::format("the boundary element mesh is not closed at the side between vertices {} and "
                      "{}: repair it before it is remeshed",
                      side.first, side.second));
    }
  }
}

Eigen::MatrixXd rigid_motions(const BoundaryElements& elements) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3& v : elements.vertices)
    centre += v / static_cast<double>(elements.vertices.size());
  Eigen::MatrixXd motions(static_cast<Eigen::Index>(elements.unknowns()), 6);
  for (std::size_t v = 0; v < elements.vertices.size(); ++v) {
    const Vec3 arm = elements.vertices[v] - centre;
    for (int k = 0; k < 3; ++k) {
      const Vec3 axis = Vec3::Unit(k);
      motions.block<3, 1>(3 * static_cast<Eigen::Index>(v), k) = axis;
      motions.block<3, 1>(3 * static_cast<Eigen::Index>(v), 3 + k) = axis.cross(arm);
    }
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(motions);
  return qr.householderQ() * Eigen::MatrixXd::Identity(motions.rows(), 6);
}

}  // namespace

ElasticCost predict_cost(std::size_t triangles) {
  const double n = static_cast<double>(triangles);
  const double unknowns = 1.5 * n;  // three for each of n / 2 vertices
  ElasticCost cost;
  // The matrix, a strip of integrals, the surface and the rigid motions.
  cost.bytes =
      static_cast<std::uint64_t>(8 * unknowns * unknowns + n * (6 * 32 * 8 + 16 * 72 + 600));
  cost.assembly_seconds = 0.08e-6 * n * n;
  cost.factor_seconds = unknowns * unknowns * unknowns / 3 / 25e9;
  return cost;
}

ElasticBody::ElasticBody(const TriangleMesh& mesh, const Material& material, Context& context)
    : material_(material) {
  check_elastic_material(material);
  const ElasticCost cost = predict_cost(mesh.faces.size());
  const std::uint64_t available = available_memory();
  if (cost.bytes > available) {
    throw InputError(fmt::format(
        "a boundary element body of {} triangles needs {:.1f} GB of memory and {:.1f} GB "
        "are available: ask for fewer triangles",
        mesh.faces.size(), 1e-9 * static_cast<double>(cost.bytes),
        1e-9 * static_cast<double>(available)));
  }
  check_closed(mesh);
  elements_ = make_boundary_elements(mesh);
  {
    const StageTimer::Scope stage = context.timer.stage("assemble");
    factor_ = assemble_hypersingular(elements_, material_, context);
  }
  const StageTimer::Scope stage = context.timer.stage("factorise");
  const auto n = static_cast<int>(factor_.rows());
  rigid_ = bem::rigid_motions(elements_);
  openblas_set_num_threads(context.threads);
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n, 6, factor_.trace() / n, rigid_.data(), n,
              1, factor_.data(), n);
  const lapack_int info = LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', n, factor_.data(), n);
  if (info != 0) {
    throw MethodFailure(
        fmt::format("the boundary element matrix of {} unknowns is not positive definite (Cholesky "
                    "stopped at {}): the surface has very slender triangles or nearly touches "
                    "itself; remesh it",
                    n, info));
  }
}

Eigen::VectorXd ElasticBody::displacements(const Eigen::Matrix3Xd& tractions,
                                           const Context& context) const {
  Eigen::MatrixXd load =
      0.5 * traction_moments(elements_, tractions) -
      apply_adjoint_double_layer(elements_, tractions, elements_, material_, context);
  load -= rigid_ * (rigid_.transpose() * load);
  openblas_set_num_threads(context.threads);
  solve_in_place(load);
  load -= rigid_ * (rigid_.transpose() * load);
  return load.col(0);
}

void ElasticBody::solve_in_place(Eigen::Ref<Eigen::MatrixXd> right_sides) const {
  const auto n = static_cast<lapack_int>(factor_.rows());
  LAPACKE_dpotrs(LAPACK_COL_MAJOR, 'L', n, static_cast<lapack_int>(right_sides.cols()),
                 factor_.data(), n, right_sides.data(),
                 static_cast<lapack_int>(right_sides.outerStride()));
}

void ElasticBody::solve_lower_in_place(Eigen::Ref<Eigen::MatrixXd> right_sides) const {
  const auto n = static_cast<int>(factor_.rows());
  cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n,
              static_cast<int>(right_sides.cols()), 1, factor_.data(), n, right_sides.data(),
              static_cast<int>(right_sides.outerStride()));
}

}  // namespace fracbench::bem
