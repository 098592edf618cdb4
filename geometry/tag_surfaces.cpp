#include "geometry/tag_surfaces.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>

#include "core/parallel.h"
#include "geometry/components.h"
#include "geometry/measures.h"
#include "geometry/surface_distance.h"

namespace fracbench {
namespace {

Vec3 centroid(const TriangleMesh& mesh, std::size_t face) {
  return (mesh.corner(face, 0) + mesh.corner(face, 1) + mesh.corner(face, 2)) / 3;
}

double longest_edge(const TriangleMesh& mesh, std::size_t face) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    longest = std::max(longest, (mesh.corner(face, k) - mesh.corner(face, (k + 1) % 3)).norm());
  }
  return longest;
}

// The original faces of one fragment, as numbers of faces of the body; -1 elsewhere.
class OriginalFaces {
 public:
  OriginalFaces(const TriangleMesh& body, const TagOptions& options)
      : body_(body),
        surface_(body),
        tolerance_(options.surface_tolerance * bounding_box(body).longest_side()),
        agreement_(options.normal_agreement) {}

  std::vector<std::int32_t> find(const TriangleMesh& mesh) const {
    std::vector<SurfaceDistance::Nearest> corners;
    corners.reserve(mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices) corners.push_back(surface_.nearest(vertex));

    std::vector<std::int32_t> result(mesh.faces.size(), -1);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto near = [&](std::int32_t v) { return corners[v].distance <= tolerance_; };
      if (!std::ranges::all_of(mesh.faces[f], near)) continue;
      const SurfaceDistance::Nearest middle = surface_.nearest(centroid(mesh, f));
      if (middle.distance > tolerance_) continue;
      const Vec3 normal = area_vector2(mesh, f);
      const bool thin = normal.norm() <= tolerance_ * longest_edge(mesh, f);
      const std::array<std::int32_t, 4> candidates{middle.face, corners[mesh.faces[f][0]].face,
                                                   corners[mesh.faces[f][1]].face,
                                                   corners[mesh.faces[f][2]].face};
      const auto agrees = [&](std::int32_t face) {
        return thin ||
               normal.normalized().dot(area_vector2(body_, face).normalized()) >= agreement_;
      };
      const auto found = std::ranges::find_if(candidates, agrees);
      if (found != candidates.end()) result[f] = *found;
    }
    return result;
  }

 private:
  const TriangleMesh& body_;
  SurfaceDistance surface_;
  double tolerance_;  // m
  double agreement_;
};

// The fracture surface of one fragment.
struct FractureSurface {
  explicit FractureSurface(const TriangleMesh& mesh) : box(bounding_box(mesh)) {
    if (!mesh.empty()) tree.emplace(mesh);
  }
  double box_distance(const Vec3& p) const {
    return (p - p.cwiseMax(box.low).cwiseMin(box.high)).norm();
  }
  BoundingBox box;
  std::optional<SurfaceDistance> tree;
};

// The fragment other than `self` whose fracture surface is nearest to the point; -1: none in reach.
std::int32_t nearest_other(const std::vector<FractureSurface>& surfaces, std::size_t self,
                           const Vec3& point, double reach) {
  std::int32_t best = -1;
  double distance = reach;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (i == self || !surfaces[i].tree || surfaces[i].box_distance(point) > distance) continue;
    const double here = surfaces[i].tree->nearest(point).distance;
    if (here < distance || (best < 0 && here <= distance)) {
      distance = here;
      best = static_cast<std::int32_t>(i);
    }
  }
  return best;
}

}  // namespace

Fragments tag_fragments(const TriangleMesh& body, std::vector<TriangleMesh> meshes,
                        const TagOptions& options) {
  const std::size_t count = meshes.size();
  std::vector<std::vector<std::int32_t>> original(count);
  const OriginalFaces finder(body, options);
  parallel_for(count, options.threads,
               [&](std::size_t i) { original[i] = finder.find(meshes[i]); });

  std::vector<FractureSurface> surfaces;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<std::uint8_t> selected;
    for (const std::int32_t face : original[i]) selected.push_back(face < 0 ? 1 : 0);
    surfaces.emplace_back(extract_faces(meshes[i], selected).mesh);
  }
  const double reach = options.interface_reach * bounding_box(body).longest_side();
  std::vector<std::vector<std::int32_t>> others(count);
  parallel_for(count, options.threads, [&](std::size_t i) {
    others[i].assign(original[i].size(), -1);
    for (std::size_t f = 0; f < original[i].size(); ++f) {
      if (original[i][f] >= 0) continue;
      others[i][f] = nearest_other(surfaces, i, centroid(meshes[i], f), reach);
    }
  });

  using Pair = std::pair<std::int32_t, std::int32_t>;
  std::map<Pair, std::int32_t> interfaces;
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::int32_t other : others[i]) {
      if (other >= 0) interfaces[std::minmax(static_cast<std::int32_t>(i), other)] = 0;
    }
  }
  std::int32_t next = 0;
  for (auto& [pair, number] : interfaces) number = next++;

  Fragments fragments(count);
  for (std::size_t i = 0; i < count; ++i) {
    fragments[i].piece = static_cast<std::int32_t>(i);
    for (std::size_t f = 0; f < original[i].size(); ++f) {
      FragmentFace tag{.original_face = original[i][f]};
      if (others[i][f] >= 0) {
        tag.interface = interfaces.at(std::minmax(static_cast<std::int32_t>(i), others[i][f]));
      }
      fragments[i].faces.push_back(tag);
    }
    fragments[i].mesh = std::move(meshes[i]);
  }
  return fragments;
}

}  // namespace fracbench
