#include "methods/bem/crack_system.h"

#include <lapacke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "methods/bem/blas_threads.h"
#include "methods/bem/elastic_operator.h"
#include "methods/bem/rigid_parts.h"

namespace fracbench::bem {
namespace {

/// Solves a x = b in place on at most `threads` threads of BLAS; `a` is destroyed.
void solve_positive(Eigen::MatrixXd& a, Eigen::VectorXd& b, int threads) {
  const auto size = static_cast<lapack_int>(a.rows());
  if (size == 0) return;
  set_blas_threads(size, threads);
  lapack_int info = LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', size, a.data(), size);
  if (info == 0) {
    info = LAPACKE_dpotrs(LAPACK_COL_MAJOR, 'L', size, 1, a.data(), size, b.data(), size);
  }
  if (info != 0 || !b.allFinite()) {
    throw MethodFailure("the system of the cracks, " + std::to_string(size) +
                        " unknowns, cannot be factored (LAPACK says " + std::to_string(info) +
                        "): the mesh of the body or of a crack is too poor");
  }
}

std::vector<char> on_boundary(const CrackSheet& sheet) {
  std::vector<char> boundary(sheet.mesh.vertices.size(), 0);
  for (const std::int32_t v : sheet.boundary) boundary[v] = 1;
  return boundary;
}

}  // namespace

Openings openings_in_infinite_body(std::span<const CrackSheet> cracks, const Mat3& stress,
                                   const Material& material, const Context& context) {
  check_elastic_material(material);
  std::vector<BoundaryElements> parts;
  for (const CrackSheet& crack : cracks) parts.push_back(make_boundary_elements(crack.mesh));
  const BoundaryElements elements = join_boundary_elements(parts);
  std::vector<Eigen::Index> free;  // unknown of each free component, in the joined elements
  Eigen::Index first = 0;
  for (const CrackSheet& crack : cracks) {
    const std::vector<char> boundary = on_boundary(crack);
    for (std::size_t v = 0; v < boundary.size(); ++v, first += 3) {
      if (boundary[v] == 0) free.insert(free.end(), {first, first + 1, first + 2});
    }
  }
  Eigen::Matrix3Xd tractions(3, static_cast<Eigen::Index>(elements.size()));
  for (std::size_t t = 0; t < elements.size(); ++t) {
    tractions.col(static_cast<Eigen::Index>(t)) = stress * elements.normals[t];
  }
  const Eigen::MatrixXd whole = assemble_hypersingular(elements, material, context);
  const Eigen::VectorXd loads = traction_moments(elements, tractions);
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd matrix(count, count);
  Eigen::VectorXd solution(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    solution[j] = loads[free[j]];
    for (Eigen::Index i = 0; i < count; ++i) matrix(i, j) = whole(free[i], free[j]);
  }
  context.stop_if_asked();
  solve_positive(matrix, solution, context.threads);

  Eigen::VectorXd all = Eigen::VectorXd::Zero(first);
  for (Eigen::Index i = 0; i < count; ++i) all[free[i]] = solution[i];
  Openings openings;
  Eigen::Index next = 0;
  for (const CrackSheet& crack : cracks) {
    auto& opening = openings.emplace_back(crack.mesh.vertices.size());
    for (Vec3& w : opening) {
      w = all.segment<3>(next);
      next += 3;
    }
  }
  return openings;
}

namespace {

/// A vertex of surface or sheet as a combination of the unknowns' vertices.
struct Combination {
  int count = 0;
  std::array<std::pair<std::int32_t, double>, 4> terms;

  void add(std::int32_t unknown, double factor) {
    for (int k = 0; k < count; ++k) {
      if (terms[k].first != unknown) continue;
      terms[k].second += factor;
      if (terms[k].second == 0) terms[k] = terms[--count];
      return;
    }
    terms[count++] = {unknown, factor};
  }
};

/// How the vertices of surface and sheets, in this order, hang on the unknowns.
struct Unknowns {
  std::vector<Combination> vertices;
  std::int32_t count = 0;  ///< of vertices that carry unknowns: first those of the surface

  Eigen::VectorXd reduce(const Eigen::VectorXd& loads) const {
    Eigen::VectorXd reduced = Eigen::VectorXd::Zero(3 * count);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      for (int k = 0; k < vertices[v].count; ++k) {
        const auto& [unknown, factor] = vertices[v].terms[k];
        reduced.segment<3>(3 * unknown) += factor * loads.segment<3>(3 * v);
      }
    }
    return reduced;
  }

  Eigen::MatrixXd reduce(const Eigen::MatrixXd& matrix) const {
    Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(3 * count, 3 * count);
    for (std::size_t j = 0; j < vertices.size(); ++j) {
      for (int l = 0; l < vertices[j].count; ++l) {
        const auto& [column, column_factor] = vertices[j].terms[l];
        for (std::size_t i = 0; i < vertices.size(); ++i) {
          for (int k = 0; k < vertices[i].count; ++k) {
            const auto& [row, row_factor] = vertices[i].terms[k];
            reduced.block<3, 3>(3 * row, 3 * column) +=
                row_factor * column_factor * matrix.block<3, 3>(3 * i, 3 * j);
          }
        }
      }
    }
    return reduced;
  }

  Vec3 value(const Eigen::VectorXd& solution, std::size_t vertex) const {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < vertices[vertex].count; ++k) {
      const auto& [unknown, factor] = vertices[vertex].terms[k];
      sum += factor * solution.segment<3>(3 * unknown);
    }
    return sum;
  }
};

Unknowns make_unknowns(const CrackedSurface& body, const std::vector<std::size_t>& first_of_sheet) {
  Unknowns unknowns;
  for (std::size_t v = 0; v < body.surface.vertices.size(); ++v) {
    unknowns.vertices.emplace_back().add(unknowns.count++, 1);
  }
  for (const CrackSheet& sheet : body.sheets) {
    for (const char boundary : on_boundary(sheet)) {
      Combination& vertex = unknowns.vertices.emplace_back();
      if (boundary == 0) vertex.add(unknowns.count++, 1);
    }
  }
  for (const MouthVertex& mouth : body.mouths) {
    Combination& vertex = unknowns.vertices[first_of_sheet[mouth.sheet] + mouth.vertex];
    for (const std::int32_t v : mouth.lower) vertex.add(v, 0.5);
    for (const std::int32_t v : mouth.upper) vertex.add(v, -0.5);
  }
  return unknowns;
}

}  // namespace

CrackedSolution CrackSystem::solve(const CrackedSurface& body, const Eigen::Matrix3Xd& tractions,
                                   const Context& context) {
  std::vector<BoundaryElements> parts{make_boundary_elements(body.surface)};
  std::vector<std::size_t> first_of_sheet;
  std::size_t first = body.surface.vertices.size();
  for (const CrackSheet& sheet : body.sheets) {
    parts.push_back(make_boundary_elements(sheet.mesh));
    first_of_sheet.push_back(first);
    first += sheet.mesh.vertices.size();
  }
  const BoundaryElements elements = join_boundary_elements(parts);
  const Unknowns unknowns = make_unknowns(body, first_of_sheet);

  Eigen::VectorXd loads =
      -apply_adjoint_double_layer(parts[0], tractions, elements, material_, context);
  loads.head(static_cast<Eigen::Index>(parts[0].unknowns())) +=
      traction_moments(parts[0], tractions) / 2;
  Eigen::VectorXd solution = unknowns.reduce(loads);

  Eigen::MatrixXd matrix = unknowns.reduce(operator_.update(elements, context));
  unknowns_ = static_cast<std::size_t>(matrix.rows());
  context.stop_if_asked();
  // Adding the rigid motions, which the operator takes to 0, makes it positive definite.
  const Eigen::MatrixXd rigid = rigid_motions(body);
  const double scale = matrix.trace() / static_cast<double>(matrix.rows());
  matrix.selfadjointView<Eigen::Lower>().rankUpdate(rigid, scale);
  solution -= rigid * (rigid.transpose() * solution);
  solve_positive(matrix, solution, context.threads);

  CrackedSolution result;
  for (std::size_t v = 0; v < body.surface.vertices.size(); ++v) {
    result.displacements.push_back(unknowns.value(solution, v));
  }
  for (std::size_t s = 0; s < body.sheets.size(); ++s) {
    auto& opening = result.openings.emplace_back();
    for (std::size_t v = 0; v < body.sheets[s].mesh.vertices.size(); ++v) {
      opening.push_back(-unknowns.value(solution, first_of_sheet[s] + v));
    }
  }
  return result;
}

}  // namespace fracbench::bem
