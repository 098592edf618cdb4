#include "scenarios/shapes/solid_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "core/error.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "geometry/repair_mesh.h"

namespace fracbench {
namespace {

/// Whether no two faces run along one edge in the same direction. By position, so that duplicated
/// vertices do not hide it.
bool neighbours_agree(const TriangleMesh& mesh) {
  using Point = std::array<double, 3>;
  std::set<std::pair<Point, Point>> seen;
  const auto point = [&](std::int32_t v) {
    const Vec3& p = mesh.vertices[v];
    return Point{p.x(), p.y(), p.z()};
  };
  for (const Face& face : mesh.faces) {
    for (int k = 0; k < 3; ++k) {
      const Point from = point(face[k]), to = point(face[(k + 1) % 3]);
      if (from != to && !seen.emplace(from, to).second) return false;
    }
  }
  return true;
}

}  // namespace

SolidFile read_solid(const std::filesystem::path& file) {
  const std::string name = file.string();
  SolidFile result{read_mesh(file), {}};
  // Self-intersections are the slow part of a check and no repair changes them: once, at the end.
  if (!check_mesh(result.mesh, {.self_intersections = false}).is_solid()) {
    const RepairedMesh repaired = repair_mesh(result.mesh);
    const double before = volume(result.mesh), after = volume(repaired.mesh);
    const bool turned = std::abs(before - after) > 1e-9 * std::abs(after);
    if (turned && check_mesh(repaired.mesh, {.self_intersections = false}).is_solid() &&
        neighbours_agree(result.mesh)) {
      throw InputError(fmt::format(
          "{}: the mesh is inverted: its faces, or those of one of its shells, are wound clockwise "
          "seen from outside (signed volume {:.6g}, with all shells turned outward {:.6g}); flip "
          "the faces in a mesh editor (in Blender: Mesh > Normals > Recalculate Outside)",
          name, before, after));
    }
    result.mesh = repaired.mesh;
    result.notes = repaired.actions;
  }
  require_solid(result.mesh, name);
  return result;
}

}  // namespace fracbench
