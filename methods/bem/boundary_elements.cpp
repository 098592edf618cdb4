#include "methods/bem/boundary_elements.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace fracbench::bem {

BoundaryElements make_boundary_elements(const TriangleMesh& mesh) {
  BoundaryElements elements;
  elements.vertices = mesh.vertices;
  elements.triangles = mesh.faces;
  const std::size_t count = mesh.faces.size();
  elements.areas.reserve(count);
  elements.normals.reserve(count);
  elements.centroids.reserve(count);
  elements.radii.reserve(count);
  elements.curls.reserve(count);
  for (std::size_t f = 0; f < count; ++f) {
    const Corners corners = elements.corners(f);
    std::array<Vec3, 3> opposite;  // the side opposite each corner, counter-clockwise
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      opposite[k] = corners[(k + 2) % 3] - corners[(k + 1) % 3];
      longest = std::max(longest, opposite[k].norm());
    }
    const Vec3 cross = opposite[1].cross(opposite[2]);
    const double doubled = cross.norm();
    if (!(doubled > 1e-9 * longest * longest) || !std::isfinite(doubled)) {
      throw InputError(
          fmt::format("boundary element {} has no area (longest side {:g} m, area {:g} m^2): "
                      "remesh the surface",
                      f, longest, doubled / 2));
    }
    const Vec3 centroid = (corners[0] + corners[1] + corners[2]) / 3;
    double radius = 0;
    for (const Vec3& corner : corners) radius = std::max(radius, (corner - centroid).norm());
    elements.areas.push_back(doubled / 2);
    elements.normals.push_back(cross / doubled);
    elements.centroids.push_back(centroid);
    elements.radii.push_back(radius);
    // The gradient of a hat function is n x (opposite side) / (2 area).
    elements.curls.push_back(
        {-opposite[0] / doubled, -opposite[1] / doubled, -opposite[2] / doubled});
  }
  return elements;
}

BoundaryElements join_boundary_elements(std::span<const BoundaryElements> parts) {
  BoundaryElements all;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const BoundaryElements& part : parts) {
    const auto shift = static_cast<std::int32_t>(all.vertices.size());
    append(all.vertices, part.vertices);
    for (const Face& face : part.triangles) {
      all.triangles.push_back({face[0] + shift, face[1] + shift, face[2] + shift});
    }
    append(all.areas, part.areas);
    append(all.normals, part.normals);
    append(all.centroids, part.centroids);
    append(all.radii, part.radii);
    append(all.curls, part.curls);
  }
  return all;
}

std::vector<std::vector<std::int32_t>> triangles_around_vertices(const BoundaryElements& elements) {
  std::vector<std::vector<std::int32_t>> around(elements.vertices.size());
  for (std::size_t f = 0; f < elements.size(); ++f) {
    for (const std::int32_t v : elements.triangles[f]) {
      around[v].push_back(static_cast<std::int32_t>(f));
    }
  }
  return around;
}

}  // namespace fracbench::bem
