#include "geometry/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <map>

namespace fracbench {

namespace {

using Indices = std::vector<unsigned int>;

Indices collapsed(const Indices& indices, const std::vector<float>& positions, double share) {
  Indices result(indices.size());
  const auto wanted = static_cast<std::size_t>(share * static_cast<double>(indices.size()) / 3) * 3;
  constexpr float any_error = 0.02F;  // of the extent: coarser would show
  const std::size_t count = meshopt_simplify(
      result.data(), indices.data(), indices.size(), positions.data(), positions.size() / 3,
      3 * sizeof(float), wanted, any_error, meshopt_SimplifyLockBorder, nullptr);
  result.resize(count);
  return result;
}

}  // namespace

GroupedMesh simplify(const TriangleMesh& mesh, std::span<const std::int32_t> groups,
                     std::size_t faces) {
  std::map<std::int32_t, Indices> by_group;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    Indices& indices = by_group[groups[f]];
    for (const std::int32_t v : mesh.faces[f]) indices.push_back(static_cast<unsigned int>(v));
  }
  if (mesh.faces.size() > faces) {
    std::vector<float> positions;
    for (const Vec3& v : mesh.vertices) {
      for (int k = 0; k < 3; ++k) positions.push_back(static_cast<float>(v[k]));
    }
    const double share = static_cast<double>(faces) / static_cast<double>(mesh.faces.size());
    for (auto& [group, indices] : by_group) indices = collapsed(indices, positions, share);
  }
  GroupedMesh result;
  std::vector<std::int32_t> place(mesh.vertices.size(), -1);
  for (const auto& [group, indices] : by_group) {
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      Face face{};
      for (std::size_t k = 0; k < 3; ++k) {
        std::int32_t& at = place[indices[i + k]];
        if (at < 0) {
          at = static_cast<std::int32_t>(result.mesh.vertices.size());
          result.mesh.vertices.push_back(mesh.vertices[indices[i + k]]);
        }
        face[k] = at;
      }
      result.mesh.faces.push_back(face);
      result.groups.push_back(group);
    }
  }
  return result;
}

}  // namespace fracbench
