#include "methods/bem/front_profile.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/measures.h"

namespace fracbench::bem {
namespace {

/// A point where the plane cuts the sheet: between two vertices, or at one (both the same).
struct CutPoint {
  std::array<std::int32_t, 2> between{-1, -1};
  double weight = 0;  ///< of the second vertex
};

}  // namespace

FrontProfiles::FrontProfiles(const CrackSheet& sheet)
    : sheet_(&sheet), faces_at_(sheet.mesh.vertices.size()) {
  for (std::size_t f = 0; f < sheet.mesh.faces.size(); ++f) {
    for (const std::int32_t v : sheet.mesh.faces[f]) {
      faces_at_[v].push_back(static_cast<std::int32_t>(f));
    }
  }
}

FrontProfile FrontProfiles::behind(std::size_t index, const FrontFrame& frame,
                                   std::span<const Vec3> opening) const {
  const TriangleMesh& mesh = sheet_->mesh;
  const std::int32_t start = sheet_->boundary[index];
  const Vec3 origin = mesh.vertices[start];
  FrontProfile profile{.distances = {0}, .openings = {opening[start]}};

  double areas = 0;
  for (const std::int32_t f : faces_at_[start]) areas += area_vector2(mesh, f).norm() / 2;
  const double count = static_cast<double>(std::max<std::size_t>(faces_at_[start].size(), 1));
  profile.edge_length = std::sqrt(areas / count * 4 / std::sqrt(3.0));

  // Vertices within a thousandth of an edge of the plane count as on it, so that no line slips
  // between two triangles.
  const double width = 1e-3 * profile.edge_length;
  const auto side = [&](std::int32_t v) {
    const double height = (mesh.vertices[v] - origin).dot(frame.tangent);
    return std::abs(height) <= width ? 0.0 : height;
  };
  // Where the plane leaves face f other than at `from`: the point furthest back.
  const auto leave = [&](std::int32_t f, const CutPoint& from, const Vec3& from_position,
                         CutPoint& to, Vec3& to_position) {
    double best = width;
    const auto offer = [&](const CutPoint& point, const Vec3& position) {
      const double way = (position - from_position).dot(-frame.forward);
      const double length = (position - from_position).norm();
      // On a strongly kinked sheet the way may turn: any way on counts once the front is left.
      const double gain = from.between[0] == start && from.between[1] == start ? way : length;
      if (gain > best) {
        best = gain;
        to = point;
        to_position = position;
      }
    };
    const Face& face = mesh.faces[f];
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = std::min(face[k], face[(k + 1) % 3]);
      const std::int32_t b = std::max(face[k], face[(k + 1) % 3]);
      if (side(face[k]) == 0 && face[k] != start) {
        offer({{face[k], face[k]}, 0}, mesh.vertices[face[k]]);
      }
      if (side(a) * side(b) < 0) {
        const double weight = side(a) / (side(a) - side(b));
        offer({{a, b}, weight}, (1 - weight) * mesh.vertices[a] + weight * mesh.vertices[b]);
      }
    }
    return best > width;
  };

  CutPoint at{{start, start}, 0};
  Vec3 position = origin;
  std::int32_t previous_face = -1;
  std::int32_t before_previous = -1;
  for (std::size_t step = 0; step <= mesh.faces.size(); ++step) {
    CutPoint next;
    Vec3 next_position = position;
    std::int32_t next_face = -1;
    double furthest = -HUGE_VAL;
    for (const std::int32_t f : faces_at_[at.between[0]]) {
      const Face& face = mesh.faces[f];
      if (f == previous_face || f == before_previous) continue;
      if (std::find(face.begin(), face.end(), at.between[1]) == face.end()) continue;
      CutPoint candidate;
      Vec3 candidate_position = position;
      if (!leave(f, at, position, candidate, candidate_position)) continue;
      const double back = (candidate_position - origin).dot(-frame.forward);
      if (back > furthest) {
        furthest = back;
        next = candidate;
        next_position = candidate_position;
        next_face = f;
      }
    }
    if (next_face < 0) break;
    const double length = (next_position - position).norm();
    // A step back into the face just left (over a vertex on the plane) ends the line.
    if ((next_position - origin).norm() + width < (position - origin).norm() &&
        profile.distances.size() > 1) {
      break;
    }
    profile.distances.push_back(profile.distances.back() + length);
    profile.openings.push_back((1 - next.weight) * opening[next.between[0]] +
                               next.weight * opening[next.between[1]]);
    before_previous = previous_face;
    previous_face = next_face;
    at = next;
    position = next_position;
  }
  return profile;
}

}  // namespace fracbench::bem
