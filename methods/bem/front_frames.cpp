#include "methods/bem/front_frames.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "core/error.h"
#include "geometry/measures.h"

namespace fracbench::bem {
namespace {

void check(const CrackSheet& sheet) {
  if (sheet.boundary.size() < 3 || sheet.boundary.size() != sheet.states.size()) {
    throw InputError("a crack has a boundary of " + std::to_string(sheet.boundary.size()) +
                     " vertices with " + std::to_string(sheet.states.size()) +
                     " states: give at least three vertices and one state for each");
  }
  for (const std::int32_t vertex : sheet.boundary) {
    if (vertex < 0 || static_cast<std::size_t>(vertex) >= sheet.mesh.vertices.size()) {
      throw InputError("the boundary of a crack names vertex " + std::to_string(vertex) + " of " +
                       std::to_string(sheet.mesh.vertices.size()));
    }
  }
}

/// Sum of the adjacent triangles' unit normals times their angles, for every vertex.
std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 normal = area_vector2(mesh, f);
    const double length = normal.norm();
    if (!(length > 0)) continue;
    for (int k = 0; k < 3; ++k) {
      const Vec3 one = mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k);
      const Vec3 other = mesh.corner(f, (k + 2) % 3) - mesh.corner(f, k);
      normals[mesh.faces[f][k]] += std::atan2(length, one.dot(other)) / length * normal;
    }
  }
  return normals;
}

/// The vertex of a closed boundary that is the fewest steps from `from` among those marked.
std::size_t nearest_along(const std::vector<std::uint8_t>& marked, std::size_t from) {
  const std::size_t count = marked.size();
  for (std::size_t steps = 1; steps <= count / 2; ++steps) {
    for (const std::size_t other : {(from + count - steps) % count, (from + steps) % count}) {
      if (marked[other]) return other;
    }
  }
  throw MethodFailure("a crack has no plane anywhere on its boundary");
}

}  // namespace

std::vector<FrontFrame> front_frames(const CrackSheet& sheet) {
  check(sheet);
  const std::vector<Vec3> normals = vertex_normals(sheet.mesh);
  const std::size_t count = sheet.boundary.size();
  std::vector<FrontFrame> frames(count);
  std::vector<std::uint8_t> has_plane(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count;
    const std::size_t after = (i + 1) % count;
    const auto advances = [&](std::size_t k) { return sheet.states[k] == FrontState::advancing; };
    const auto position = [&](std::size_t k) { return sheet.mesh.vertices[sheet.boundary[k]]; };
    const Vec3 in = position(i) - position(before);
    const Vec3 out = position(after) - position(i);
    // Tangent of the circle through three points: each chord's direction times the other's length.
    Vec3 along = in.normalized() * out.norm() + out.normalized() * in.norm();
    if (!advances(i) && advances(before) != advances(after)) along = advances(before) ? in : out;
    const Vec3 tangent = -along.normalized();
    const Vec3 mean = normals[sheet.boundary[i]];
    const Vec3 normal = mean - mean.dot(tangent) * tangent;
    if (!(along.norm() > 0) || !(normal.norm() > 1e-9 * mean.norm())) continue;
    has_plane[i] = 1;
    frames[i].tangent = tangent;
    frames[i].normal = normal.normalized();
    frames[i].forward = frames[i].normal.cross(tangent);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!has_plane[i]) frames[i] = frames[nearest_along(has_plane, i)];
  }
  return frames;
}

double sheet_area(const CrackSheet& sheet) { return area(sheet.mesh); }

}  // namespace fracbench::bem
