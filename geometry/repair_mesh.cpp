#include "geometry/repair_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

#include "geometry/components.h"
#include "geometry/edge_table.h"
#include "geometry/equal_vertices.h"
#include "geometry/shell_nesting.h"

namespace fracbench {

namespace {

std::string counted(std::string_view did, std::size_t count, std::string_view one,
                    std::string_view many) {
  return fmt::format("{} {} {}", did, count, count == 1 ? one : many);
}

bool indices_in_range(const TriangleMesh& mesh) {
  const auto count = static_cast<std::int32_t>(mesh.vertices.size());
  return std::all_of(mesh.faces.begin(), mesh.faces.end(), [&](const Face& face) {
    return std::all_of(face.begin(), face.end(),
                       [&](std::int32_t v) { return v >= 0 && v < count; });
  });
}

TriangleMesh renumbered(const TriangleMesh& mesh, const std::vector<std::int32_t>& target) {
  TriangleMesh result{mesh.vertices, mesh.faces};
  for (Face& face : result.faces) {
    for (std::int32_t& v : face) v = target[v];
  }
  return result;
}

/// Vertices on open edges that are equal become one, but for those at whose edges more than two
/// faces would then meet.
std::size_t weld(TriangleMesh& mesh) {
  std::vector<std::uint8_t> may_weld(mesh.vertices.size(), 0);
  EdgeTable(mesh).for_each_edge([&](std::int32_t low, std::int32_t high, const auto& sides) {
    if (sides.size() == 1) may_weld[low] = may_weld[high] = 1;
  });
  const std::vector<std::int32_t> first = first_equal_vertex(mesh.vertices);
  for (;;) {
    // The target is the first of the equal ones that may be welded.
    std::vector<std::int32_t> target(first.size()), chosen(first.size(), -1);
    for (std::size_t v = 0; v < first.size(); ++v) {
      target[v] = static_cast<std::int32_t>(v);
      if (!may_weld[v]) continue;
      if (chosen[first[v]] < 0) chosen[first[v]] = static_cast<std::int32_t>(v);
      target[v] = chosen[first[v]];
    }
    TriangleMesh welded = renumbered(mesh, target);
    bool again = false;
    EdgeTable(welded).for_each_edge([&](std::int32_t, std::int32_t, const auto& sides) {
      if (sides.size() <= 2) return;
      for (const EdgeTable::Side& side : sides) {
        for (const int k : {side.k + 0, (side.k + 1) % 3}) {
          const std::int32_t v = mesh.faces[side.face][k];
          if (target[v] == v) continue;
          may_weld[v] = 0;
          again = true;
        }
      }
    });
    if (again) continue;
    mesh = std::move(welded);
    std::size_t count = 0;
    for (std::size_t v = 0; v < target.size(); ++v) {
      count += target[v] != static_cast<std::int32_t>(v);
    }
    return count;
  }
}

struct Dropped {
  std::size_t repeated = 0, duplicate = 0;
};

/// Faces with two corners at one place; and of faces with the same corners, turned the same way,
/// all but the first. Corners are told apart by place, since no vertices have been welded yet.
Dropped drop_faces(TriangleMesh& mesh) {
  Dropped dropped;
  const TriangleMesh by_place = renumbered(mesh, first_equal_vertex(mesh.vertices));
  std::vector<std::uint8_t> drop(mesh.faces.size(), 0);
  std::vector<std::pair<Face, std::size_t>> sorted;
  sorted.reserve(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    Face face = by_place.faces[f];
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) {
      drop[f] = 1;
      ++dropped.repeated;
      continue;
    }
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    sorted.emplace_back(face, f);
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[i - 1].first) continue;
    drop[sorted[i].second] = 1;
    ++dropped.duplicate;
  }
  std::size_t f = 0;
  std::erase_if(mesh.faces, [&](const Face&) { return drop[f++] != 0; });
  return dropped;
}

/// A part of the mesh that is connected over edges with two faces.
struct Patch {
  std::vector<std::int32_t> faces;
  std::vector<std::uint8_t> turned;  ///< against the first face, parallel to faces
  bool closed = true;
  bool orientable = true;
};

std::vector<Patch> find_patches(const TriangleMesh& mesh) {
  struct Neighbour {
    std::int32_t face = -1;
    bool opposed = false;
  };
  std::vector<std::array<Neighbour, 3>> neighbours(mesh.faces.size());
  EdgeTable(mesh).for_each_edge([&](std::int32_t, std::int32_t, const auto& sides) {
    if (sides.size() != 2) return;
    const bool opposed = sides[0].forward == sides[1].forward;
    neighbours[sides[0].face][sides[0].k] = {sides[1].face, opposed};
    neighbours[sides[1].face][sides[1].k] = {sides[0].face, opposed};
  });
  std::vector<Patch> patches;
  std::vector<std::int8_t> state(mesh.faces.size(), -1);  // whether turned; -1: not reached yet
  for (std::size_t start = 0; start < mesh.faces.size(); ++start) {
    if (state[start] >= 0) continue;
    Patch patch;
    patch.faces.push_back(static_cast<std::int32_t>(start));
    state[start] = 0;
    for (std::size_t i = 0; i < patch.faces.size(); ++i) {
      const std::int32_t f = patch.faces[i];
      for (const auto& [g, opposed] : neighbours[f]) {
        if (g < 0) {
          patch.closed = false;
          continue;
        }
        const auto wanted = static_cast<std::int8_t>(state[f] ^ static_cast<int>(opposed));
        if (state[g] < 0) {
          state[g] = wanted;
          patch.faces.push_back(g);
        } else if (state[g] != wanted) {
          patch.orientable = false;
        }
      }
    }
    for (const std::int32_t f : patch.faces) patch.turned.push_back(state[f] != 0);
    patches.push_back(std::move(patch));
  }
  return patches;
}

void turn(Face& face) { std::swap(face[1], face[2]); }

/// Makes neighbours agree, in each patch the way of most of its faces, and closed patches positive
/// (negative around cavities).
std::size_t turn_faces(TriangleMesh& mesh) {
  std::vector<std::uint8_t> turned(mesh.faces.size(), 0);
  std::vector<std::uint8_t> of_closed(mesh.faces.size(), 0);
  for (const Patch& patch : find_patches(mesh)) {
    if (!patch.orientable) continue;
    const auto count =
        static_cast<std::size_t>(std::count(patch.turned.begin(), patch.turned.end(), 1));
    const bool other_way = 2 * count > patch.faces.size();
    for (std::size_t i = 0; i < patch.faces.size(); ++i) {
      const std::int32_t f = patch.faces[i];
      turned[f] = (patch.turned[i] != 0) != other_way;
      if (turned[f]) turn(mesh.faces[f]);
      of_closed[f] = patch.closed;
    }
  }
  // Closed patches are whole components, so that they can be told apart again in a mesh of theirs.
  const MeshPart closed = extract_faces(mesh, of_closed);
  for (const ShellNesting::Shell& shell :
       shell_nesting(closed.mesh, face_components(closed.mesh)).shells) {
    const bool cavity = shell.depth % 2 == 1;
    if (cavity ? shell.volume <= 0 : shell.volume >= 0) continue;
    for (const std::int32_t part_face : shell.faces) {
      const std::int32_t f = closed.source_face[part_face];
      turn(mesh.faces[f]);
      turned[f] ^= 1;
    }
  }
  return static_cast<std::size_t>(std::count(turned.begin(), turned.end(), 1));
}

std::size_t drop_unused_vertices(TriangleMesh& mesh) {
  const std::size_t before = mesh.vertices.size();
  mesh = extract_faces(mesh, std::vector<std::uint8_t>(mesh.faces.size(), 1)).mesh;
  return before - mesh.vertices.size();
}

}  // namespace

RepairedMesh repair_mesh(const TriangleMesh& mesh) {
  RepairedMesh result{mesh, {}};
  if (!indices_in_range(mesh)) return result;
  TriangleMesh& m = result.mesh;
  const auto did = [&](std::size_t count, std::string_view what, std::string_view one,
                       std::string_view many) {
    if (count > 0) result.actions.push_back(counted(what, count, one, many));
  };
  Dropped dropped;
  std::size_t welded = 0, turned = 0;
  // Once more where that may open the way for more: each time there is less of the mesh.
  for (bool again = true; again;) {
    const Dropped now_dropped = drop_faces(m);
    const std::size_t now_welded = weld(m);
    turned += turn_faces(m);
    dropped.repeated += now_dropped.repeated;
    dropped.duplicate += now_dropped.duplicate;
    welded += now_welded;
    again = now_dropped.repeated + now_dropped.duplicate + now_welded > 0;
  }
  did(dropped.repeated, "dropped", "face with a repeated vertex", "faces with a repeated vertex");
  did(dropped.duplicate, "dropped", "duplicate face", "duplicate faces");
  did(welded, "welded", "vertex", "vertices");
  did(turned, "turned", "face", "faces");
  // The welded ones have been reported.
  did(drop_unused_vertices(m) - welded, "dropped", "unused vertex", "unused vertices");
  return result;
}

}  // namespace fracbench
