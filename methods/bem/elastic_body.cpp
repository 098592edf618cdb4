#include "methods/bem/elastic_body.h"

#include <cblas.h>
#include <fmt/format.h>
#include <lapacke.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/available_memory.h"
#include "methods/bem/blas_threads.h"
#include "methods/bem/elastic_operator.h"

namespace fracbench::bem {
namespace {

// Cholesky's factor in the lower triangle, in place, by panels: between them the work can be
// stopped and tells how far it has come. Throws MethodFailure.
void factorise(Eigen::MatrixXd& matrix, const Context& context) {
  constexpr int kPanel = 768;
  const int n = static_cast<int>(matrix.rows());
  for (int first = 0; first < n; first += kPanel) {
    context.stop_if_asked();
    const double done = 1 - std::pow(1 - static_cast<double>(first) / n, 3);
    context.progress.update("factorising the body's matrix", done);
    const int size = std::min(kPanel, n - first);
    const int rest = n - first - size;
    double* const diagonal = &matrix(first, first);
    const lapack_int info = LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', size, diagonal, n);
    if (info != 0) {
      throw MethodFailure(fmt::format(
          "the boundary element matrix of {} unknowns is not positive definite (Cholesky "
          "stopped at {}): the surface has very slender triangles or nearly touches "
          "itself; remesh it",
          n, first + info));
    }
    if (rest == 0) continue;
    double* const below = diagonal + size;
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, rest, size, 1,
                diagonal, n, below, n);
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, rest, size, -1, below, n, 1,
                &matrix(first + size, first + size), n);
  }
}

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

// The connected parts of the surface: the lowest vertex of its part for each vertex.
std::vector<std::int32_t> surface_parts(const BoundaryElements& elements) {
  std::vector<std::int32_t> part(elements.vertices.size());
  std::iota(part.begin(), part.end(), 0);
  const auto root = [&](std::int32_t v) {
    while (part[v] != v) v = part[v] = part[part[v]];
    return v;
  };
  for (const Face& face : elements.triangles) {
    for (const int k : {1, 2}) {
      const std::int32_t a = root(face[0]);
      const std::int32_t b = root(face[k]);
      part[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::size_t v = 0; v < part.size(); ++v) part[v] = root(static_cast<std::int32_t>(v));
  return part;
}

// The rigid motions of each part of the surface: D leaves all of them free, since the double layer
// of a rigid motion on a closed surface is rigid on either side.
Eigen::MatrixXd rigid_motions(const BoundaryElements& elements) {
  const std::vector<std::int32_t> part = surface_parts(elements);
  std::map<std::int32_t, std::vector<std::int32_t>> parts;
  for (std::size_t v = 0; v < part.size(); ++v) {
    parts[part[v]].push_back(static_cast<std::int32_t>(v));
  }
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(elements.unknowns()),
                                              6 * static_cast<Eigen::Index>(parts.size()));
  Eigen::Index column = 0;
  for (const auto& [first, vertices] : parts) {
    Vec3 centre = Vec3::Zero();
    for (const std::int32_t v : vertices) {
      centre += elements.vertices[v] / static_cast<double>(vertices.size());
    }
    Eigen::MatrixXd motions(3 * static_cast<Eigen::Index>(vertices.size()), 6);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vec3 arm = elements.vertices[vertices[i]] - centre;
      for (int k = 0; k < 3; ++k) {
        const Vec3 axis = Vec3::Unit(k);
        motions.block<3, 1>(3 * static_cast<Eigen::Index>(i), k) = axis;
        motions.block<3, 1>(3 * static_cast<Eigen::Index>(i), 3 + k) = axis.cross(arm);
      }
    }
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(motions);
    motions = qr.householderQ() * Eigen::MatrixXd::Identity(motions.rows(), 6);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      all.block<3, 6>(3 * static_cast<Eigen::Index>(vertices[i]), column) =
          motions.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    }
    column += 6;
  }
  return all;
}

}  // namespace

ElasticCost predict_cost(std::size_t triangles) {
  const double n = static_cast<double>(triangles);
  const double unknowns = 1.5 * n;  // three for each of n / 2 vertices
  ElasticCost cost;
  // The matrix, a strip of integrals, the surface and the rigid motions.
  cost.bytes =
      static_cast<std::uint64_t>(8 * unknowns * unknowns + n * (6 * 32 * 8 + 16 * 72 + 600));
  cost.assembly_seconds = 45e-6 * n + 0.07e-6 * n * n;
  cost.factor_seconds = unknowns * unknowns * unknowns / 3 / 35e9;
  return cost;
}

ElasticBody::ElasticBody(const TriangleMesh& mesh, const Material& material, Context& context)
    : material_(material), threads_(context.threads) {
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
  set_blas_threads(n, context.threads);
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n, static_cast<int>(rigid_.cols()),
              factor_.trace() / n, rigid_.data(), n, 1, factor_.data(), n);
  factorise(factor_, context);
}

Eigen::VectorXd ElasticBody::displacements(const Eigen::Matrix3Xd& tractions,
                                           const Context& context) const {
  Eigen::MatrixXd load =
      0.5 * traction_moments(elements_, tractions) -
      apply_adjoint_double_layer(elements_, tractions, elements_, material_, context);
  load -= rigid_ * (rigid_.transpose() * load);
  solve_in_place(load);
  load -= rigid_ * (rigid_.transpose() * load);
  return load.col(0);
}

void ElasticBody::use_threads_for(Eigen::Index right_sides) const {
  // For few right-hand sides the memory is the limit.
  set_blas_threads(right_sides < 32 ? 0 : factor_.rows(), threads_);
}

void ElasticBody::solve_in_place(Eigen::Ref<Eigen::MatrixXd> right_sides) const {
  use_threads_for(right_sides.cols());
  const auto n = static_cast<lapack_int>(factor_.rows());
  LAPACKE_dpotrs(LAPACK_COL_MAJOR, 'L', n, static_cast<lapack_int>(right_sides.cols()),
                 factor_.data(), n, right_sides.data(),
                 static_cast<lapack_int>(right_sides.outerStride()));
}

void ElasticBody::solve_lower_in_place(Eigen::Ref<Eigen::MatrixXd> right_sides) const {
  use_threads_for(right_sides.cols());
  const auto n = static_cast<int>(factor_.rows());
  cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n,
              static_cast<int>(right_sides.cols()), 1, factor_.data(), n, right_sides.data(),
              static_cast<int>(right_sides.outerStride()));
}

}  // namespace fracbench::bem
