#include "methods/bem/operator_cache.h"

#include <algorithm>
#include <utility>

#include "methods/bem/elastic_operator.h"

namespace fracbench::bem {
namespace {

/// Above this share of changed triangles it is cheaper to use the symmetry of the whole.
constexpr double kMostlyChanged = 0.5;

/// The triangles with a changed vertex and their vertices, as a surface of their own.
struct Part {
  TriangleMesh mesh;
  std::vector<std::int32_t> local;  ///< vertex of `mesh` for each vertex of the whole, or -1
};

Part changed_part(const BoundaryElements& elements, const std::vector<std::int32_t>& old_vertex) {
  Part part{.mesh = {}, .local = std::vector<std::int32_t>(elements.vertices.size(), -1)};
  for (const Face& face : elements.triangles) {
    if (std::ranges::none_of(face, [&](std::int32_t v) { return old_vertex[v] < 0; })) continue;
    Face local{};
    for (int k = 0; k < 3; ++k) {
      std::int32_t& at = part.local[face[k]];
      if (at < 0) {
        at = static_cast<std::int32_t>(part.mesh.vertices.size());
        part.mesh.vertices.push_back(elements.vertices[face[k]]);
      }
      local[k] = at;
    }
    part.mesh.faces.push_back(local);
  }
  return part;
}

}  // namespace

const Eigen::MatrixXd& OperatorCache::update(const BoundaryElements& elements,
                                             const Context& context) {
  const std::size_t count = elements.vertices.size();
  std::vector<Star> stars(count);
  for (std::size_t t = 0; t < elements.size(); ++t) {
    const Corners corners = elements.corners(t);
    for (int k = 0; k < 3; ++k) {
      std::array<double, 9>& entry = stars[elements.triangles[t][k]].emplace_back();
      for (int j = 0; j < 9; ++j) entry[j] = corners[(k + j / 3) % 3][j % 3];
    }
  }
  std::map<Star, std::int32_t> vertices;
  std::vector<std::int32_t> old_vertex(count, -1);
  for (std::size_t v = 0; v < count; ++v) {
    std::ranges::sort(stars[v]);
    const auto old = vertices_.find(stars[v]);
    // Two vertices with the same triangles (a sheet given twice) cannot both keep the entries.
    const bool fresh = vertices.emplace(std::move(stars[v]), static_cast<std::int32_t>(v)).second;
    if (fresh && old != vertices_.end()) old_vertex[v] = old->second;
  }
  vertices_ = std::move(vertices);

  const Part part = changed_part(elements, old_vertex);
  assembled_ = static_cast<std::size_t>(std::ranges::count(old_vertex, -1));
  if (static_cast<double>(part.mesh.faces.size()) >
      kMostlyChanged * static_cast<double>(elements.size())) {
    assembled_ = count;
    matrix_.resize(0, 0);
    matrix_ = assemble_hypersingular(elements, material_, context);
    return matrix_;
  }
  Eigen::MatrixXd rows;
  if (!part.mesh.faces.empty()) {
    rows = assemble_hypersingular(make_boundary_elements(part.mesh), elements, material_, context);
  }
  const auto size = static_cast<Eigen::Index>(3 * count);
  Eigen::MatrixXd next(size, size);
  for (std::size_t j = 0; j < count; ++j) {
    const auto column = static_cast<Eigen::Index>(3 * j);
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = static_cast<Eigen::Index>(3 * i);
      auto block = next.block<3, 3>(row, column);
      if (old_vertex[i] >= 0 && old_vertex[j] >= 0) {
        block = matrix_.block<3, 3>(3 * old_vertex[i], 3 * old_vertex[j]);
      } else if (old_vertex[i] < 0 && (old_vertex[j] >= 0 || i < j)) {
        block = rows.block<3, 3>(3 * part.local[i], column);
      } else if (i == j) {
        const Mat3 own = rows.block<3, 3>(3 * part.local[i], column);
        block = (own + own.transpose()) / 2;
      } else {
        block = rows.block<3, 3>(3 * part.local[j], row).transpose();
      }
    }
  }
  matrix_ = std::move(next);
  return matrix_;
}

}  // namespace fracbench::bem
