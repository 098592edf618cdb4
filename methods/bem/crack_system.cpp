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

/// The lower Cholesky factor in place; 0, or the (first) row at which `a` is not positive, from 1.
lapack_int factor(Eigen::MatrixXd& a, int threads) {
  const auto size = static_cast<lapack_int>(a.rows());
  set_blas_threads(size, threads);
  return size == 0 ? 0 : LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', size, a.data(), size);
}

void substitute(const Eigen::MatrixXd& factor, Eigen::VectorXd& b) {
  const auto size = static_cast<lapack_int>(factor.rows());
  if (size == 0) return;
  LAPACKE_dpotrs(LAPACK_COL_MAJOR, 'L', size, 1, factor.data(), size, b.data(), size);
}

void fail_unless(bool good, Eigen::Index size) {
  if (good) return;
  throw MethodFailure("the system of the cracks, " + std::to_string(size) +
                      " unknowns, cannot be factored: the mesh of the body or of a crack is too "
                      "poor, or the body too thin for its triangles");
}

/// Solves a x = b in place; `a` is destroyed.
void solve_positive(Eigen::MatrixXd& a, Eigen::VectorXd& b, int threads) {
  fail_unless(factor(a, threads) == 0, a.rows());
  substitute(a, b);
  fail_unless(b.allFinite(), a.rows());
}

/// A pivot below this share of the matrix's own diagonal counts as none: an unknown that the ones
/// before it determine already, up to the errors of the integrals.
constexpr double kLeastPivot = 1e-4;

/// The same, lower triangle of `a` only. Where the matrix is not positive definite in its rows from
/// `first_sheet` on, unknowns are held at 0. How many were.
std::size_t solve_holding(Eigen::MatrixXd& a, Eigen::VectorXd& b, Eigen::Index first_sheet,
                          int threads) {
  Eigen::MatrixXd whole = a;
  if (factor(whole, threads) == 0) {
    substitute(whole, b);
    fail_unless(b.allFinite(), a.rows());
    return 0;
  }
  whole.resize(0, 0);
  // The surface's own part, then column by column what is left for the sheets.
  const Eigen::Index size = a.rows();
  const Eigen::Index rest = size - first_sheet;
  Eigen::MatrixXd surface = a.topLeftCorner(first_sheet, first_sheet);
  fail_unless(factor(surface, threads) == 0, size);
  a.topLeftCorner(first_sheet, first_sheet) = surface;
  auto below = a.bottomLeftCorner(rest, first_sheet);
  surface.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
  auto sheets = a.bottomRightCorner(rest, rest);
  const Eigen::VectorXd diagonal = sheets.diagonal();
  sheets.selfadjointView<Eigen::Lower>().rankUpdate(below, -1);
  std::size_t held = 0;
  for (Eigen::Index j = 0; j < rest; ++j) {
    auto column = sheets.col(j).tail(rest - j);
    column.noalias() -= sheets.block(j, 0, rest - j, j) * sheets.row(j).head(j).transpose();
    if (column[0] > kLeastPivot * diagonal[j]) {
      column /= std::sqrt(column[0]);
    } else {
      ++held;
      a.row(first_sheet + j).head(first_sheet + j).setZero();
      column.setZero();
      column[0] = 1;
      b[first_sheet + j] = 0;
    }
  }
  substitute(a, b);
  fail_unless(b.allFinite(), size);
  return held;
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
  std::array<std::pair<std::int32_t, double>, 2> terms;

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
    vertex.add(mouth.lower, 1);
    vertex.add(mouth.upper, -1);
  }
  return unknowns;
}

}  // namespace

Eigen::Matrix3Xd CrackSystem::tractions(const BoundaryElements& sheet) {
  const auto key_of = [&](std::size_t t) {
    std::array<double, 9> key{};
    const Corners corners = sheet.corners(t);
    for (int j = 0; j < 9; ++j) key[j] = corners[j / 3][j % 3];
    return key;
  };
  std::vector<std::size_t> fresh;
  std::vector<Vec3> points;
  for (std::size_t t = 0; t < sheet.size(); ++t) {
    if (known_tractions_.contains(key_of(t))) continue;
    fresh.push_back(t);
    const Corners corners = sheet.corners(t);
    for (int k = 0; k < 3; ++k) points.emplace_back((corners[k] + corners[(k + 1) % 3]) / 2);
  }
  const std::vector<Mat3> stresses = points.empty() ? std::vector<Mat3>{} : stress_(points);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    const Mat3 mean = (stresses[3 * i] + stresses[3 * i + 1] + stresses[3 * i + 2]) / 3;
    known_tractions_[key_of(fresh[i])] = mean * sheet.normals[fresh[i]];
  }
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(sheet.size()));
  for (std::size_t t = 0; t < sheet.size(); ++t) {
    result.col(static_cast<Eigen::Index>(t)) = known_tractions_.at(key_of(t));
  }
  return result;
}

CrackedSolution CrackSystem::solve(const CrackedSurface& body, const Context& context) {
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

  // The sheets' unknowns are minus the openings.
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(elements.unknowns()));
  for (std::size_t s = 0; s < body.sheets.size(); ++s) {
    const BoundaryElements& sheet = parts[s + 1];
    loads.segment(static_cast<Eigen::Index>(3 * first_of_sheet[s]),
                  static_cast<Eigen::Index>(sheet.unknowns())) =
        -traction_moments(sheet, tractions(sheet));
  }
  Eigen::VectorXd solution = unknowns.reduce(loads);

  Eigen::MatrixXd matrix = unknowns.reduce(operator_.update(elements, context));
  unknowns_ = static_cast<std::size_t>(matrix.rows());
  context.stop_if_asked();
  // Adding the rigid motions, which the operator takes to 0, makes it positive definite.
  const Eigen::MatrixXd rigid = rigid_motions(body);
  const double scale = matrix.trace() / static_cast<double>(matrix.rows());
  matrix.selfadjointView<Eigen::Lower>().rankUpdate(rigid, scale);
  solution -= rigid * (rigid.transpose() * solution);
  CrackedSolution result;
  result.held =
      solve_holding(matrix, solution, static_cast<Eigen::Index>(3 * body.surface.vertices.size()),
                    context.threads);

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
