#include "geometry/components.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/sum.h"
#include "geometry/edge_table.h"
#include "geometry/shell_nesting.h"

namespace fracbench {

namespace {

/// Union-find whose roots are the smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::int32_t root(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::int32_t i, std::int32_t j) {
    i = root(i);
    j = root(j);
    if (i != j) parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::int32_t> parent_;
};

/// `renumbered` is scratch space, one entry per vertex of the mesh.
MeshPart part_of(const TriangleMesh& mesh, std::vector<std::int32_t> faces,
                 std::vector<std::int32_t>& renumbered) {
  MeshPart part;
  std::vector<std::int32_t> used;
  used.reserve(3 * faces.size());
  for (const std::int32_t f : faces) {
    used.insert(used.end(), mesh.faces[f].begin(), mesh.faces[f].end());
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  part.mesh.vertices.reserve(used.size());
  for (const std::int32_t v : used) {
    renumbered[v] = static_cast<std::int32_t>(part.mesh.vertices.size());
    part.mesh.vertices.push_back(mesh.vertices[v]);
  }
  part.mesh.faces.reserve(faces.size());
  for (const std::int32_t f : faces) {
    const Face& face = mesh.faces[f];
    part.mesh.faces.push_back({renumbered[face[0]], renumbered[face[1]], renumbered[face[2]]});
  }
  part.source_face = std::move(faces);
  return part;
}

}  // namespace

std::vector<std::int32_t> face_components(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.faces.size());
  EdgeTable(mesh).for_each_edge([&](std::int32_t, std::int32_t, const auto& sides) {
    for (const auto& side : sides) sets.join(sides[0].face, side.face);
  });
  std::vector<std::int32_t> component(mesh.faces.size());
  std::int32_t count = 0;
  for (std::size_t f = 0; f < component.size(); ++f) {
    const std::int32_t root = sets.root(static_cast<std::int32_t>(f));
    component[f] = root == static_cast<std::int32_t>(f) ? count++ : component[root];
  }
  return component;
}

MeshPart extract_faces(const TriangleMesh& mesh, const std::vector<std::uint8_t>& selected) {
  std::vector<std::int32_t> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (selected[f]) faces.push_back(static_cast<std::int32_t>(f));
  }
  std::vector<std::int32_t> renumbered(mesh.vertices.size());
  return part_of(mesh, std::move(faces), renumbered);
}

std::vector<MeshPart> solid_components(const TriangleMesh& mesh) {
  const std::vector<std::int32_t> component = face_components(mesh);
  const ShellNesting nesting = shell_nesting(mesh, component);
  // A shell at odd depth bounds a cavity of its parent; the others begin a solid of their own.
  std::vector<std::vector<std::int32_t>> solids;
  std::vector<std::size_t> solid_of(nesting.shells.size());
  for (std::size_t s = 0; s < nesting.shells.size(); ++s) {
    const ShellNesting::Shell& shell = nesting.shells[s];
    if (shell.depth % 2 == 1) continue;
    solid_of[s] = solids.size();
    solids.push_back(shell.faces);
  }
  for (const ShellNesting::Shell& shell : nesting.shells) {
    if (shell.depth % 2 == 0) continue;
    std::vector<std::int32_t>& faces = solids[solid_of[shell.parent]];
    faces.insert(faces.end(), shell.faces.begin(), shell.faces.end());
  }

  std::vector<MeshPart> parts;
  std::vector<std::int32_t> renumbered(mesh.vertices.size());
  for (std::vector<std::int32_t>& faces : solids) {
    std::sort(faces.begin(), faces.end());
    parts.push_back(part_of(mesh, std::move(faces), renumbered));
  }
  return parts;
}

std::vector<std::vector<std::int32_t>> solids_of_shells(
    const TriangleMesh& mesh, std::vector<std::vector<std::int32_t>> shells) {
  if (shells.size() <= 1) return shells;
  for (const auto& shell : shells) {
    Sum volume6;
    const Vec3 origin = mesh.corner(shell.front(), 0);
    for (const std::int32_t f : shell) {
      volume6 += (mesh.corner(f, 0) - origin)
                     .dot((mesh.corner(f, 1) - origin).cross(mesh.corner(f, 2) - origin));
    }
    if (volume6.value() > 0) continue;
    std::vector<std::vector<std::int32_t>> solids;
    for (MeshPart& part : solid_components(mesh)) solids.push_back(std::move(part.source_face));
    return solids;
  }
  return shells;
}

}  // namespace fracbench
