#include "methods/modes/cut_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/sum.h"
#include "geometry/components.h"
#include "geometry/measures.h"
#include "geometry/partition/arrangement.h"
#include "methods/modes/fans.h"
#include "methods/modes/fragment_meshes.h"
#include "methods/modes/interface_faces.h"

namespace fracbench::modes {
namespace {

using partition::Arrangement;
using partition::NotGeneric;

// How far the ends of the interfaces are moved out of the body at the first attempt, in shares of
// its size, and how much farther at each other one.
constexpr double kFirstShift = 1e-6;
constexpr double kShiftGrowth = 3;
constexpr int kAttempts = 7;
constexpr double kVolumeTolerance = 1e-10;

// From this many cells at a vertex on it is not tried which of their unions touch themselves there.
constexpr std::size_t kManyCells = 6;

/// The faces of one region, and which of the arrangement's parts they are.
struct RegionFaces {
  std::vector<Face> faces;
  std::vector<FaceRef> refs;
};

std::vector<RegionFaces> faces_by_region(const Arrangement& arrangement, std::size_t regions) {
  std::vector<RegionFaces> result(regions);
  const auto add = [&](std::int32_t region, const Face& corners, FaceRef ref) {
    if (region < 1 || region > std::ssize(result)) throw NotGeneric("a face is in no region");
    result[region - 1].faces.push_back(corners);
    result[region - 1].refs.push_back(ref);
  };
  for (std::size_t n = 0; n < arrangement.body.size(); ++n) {
    add(arrangement.body[n].region, arrangement.body[n].corners, FaceRef::surface(n));
  }
  for (std::size_t n = 0; n < arrangement.interfaces.size(); ++n) {
    const auto& [corners, sides] = arrangement.interfaces[n];
    add(sides[0], corners, FaceRef::interface(n, 0));
    add(sides[1], {corners[0], corners[2], corners[1]}, FaceRef::interface(n, 1));
  }
  return result;
}

/// The connected solids of a closed manifold, by their faces.
std::vector<std::vector<std::int32_t>> solids_of(const TriangleMesh& mesh) {
  const std::vector<std::int32_t> component = face_components(mesh);
  const std::int32_t count =
      component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
  std::vector<std::vector<std::int32_t>> shells(count);
  for (std::size_t f = 0; f < component.size(); ++f) {
    shells[component[f]].push_back(static_cast<std::int32_t>(f));
  }
  return solids_of_shells(mesh, std::move(shells));
}

double volume_of(const TriangleMesh& mesh, const std::vector<std::int32_t>& faces) {
  TriangleMesh part;
  part.vertices = mesh.vertices;
  for (const std::int32_t f : faces) part.faces.push_back(mesh.faces[f]);
  return volume(part);
}

/// Puts a vertex into the middle of every edge in which four or more interface parts meet: a union
/// of cells may touch itself in such an edge and nowhere else, and only a vertex between the edge's
/// ends can then be doubled.
void split_crowded_edges(CutBody& cut, std::vector<std::uint8_t>& candidate) {
  using Edge = std::array<std::int32_t, 2>;
  const auto edge_of = [](const Face& face, int k) {
    const auto [low, high] = std::minmax(face[k], face[(k + 1) % 3]);
    return Edge{low, high};
  };
  std::vector<Edge> edges;
  for (const auto& part : cut.interfaces) {
    for (int k = 0; k < 3; ++k) {
      const Edge edge = edge_of(part.corners, k);
      if (candidate[edge[0]] && candidate[edge[1]]) edges.push_back(edge);
    }
  }
  std::ranges::sort(edges);
  std::map<Edge, std::int32_t> middle;
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin + 1;
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    if (end - begin >= 4) {
      middle[edges[begin]] = static_cast<std::int32_t>(cut.vertices.size());
      cut.vertices.push_back((cut.vertices[edges[begin][0]] + cut.vertices[edges[begin][1]]) / 2);
      candidate.push_back(1);
    }
    begin = end;
  }
  if (middle.empty()) return;
  std::vector<CutBody::InterfacePart> parts;
  for (const auto& part : cut.interfaces) {
    std::array<std::int32_t, 3> m{-1, -1, -1};  // on the edge from corner k
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      const auto at = middle.find(edge_of(part.corners, k));
      if (at == middle.end()) continue;
      m[k] = at->second;
      ++count;
    }
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
      parts.push_back({{a, b, c}, part.cells});
    };
    // Turned so that of one middle it is the first edge's, of two those of the first two edges.
    int turn = 0;
    if (count == 1) turn = m[0] >= 0 ? 0 : m[1] >= 0 ? 1 : 2;
    if (count == 2) turn = m[0] < 0 ? 1 : m[1] < 0 ? 2 : 0;
    const auto& f = part.corners;
    const std::int32_t a = f[turn], b = f[(turn + 1) % 3], c = f[(turn + 2) % 3];
    const std::int32_t ab = m[turn], bc = m[(turn + 1) % 3], ca = m[(turn + 2) % 3];
    if (count == 0) {
      add(a, b, c);
    } else if (count == 1) {
      add(a, ab, c);
      add(ab, b, c);
    } else if (count == 2) {
      add(ab, b, bc);
      add(a, ab, bc);
      add(a, bc, c);
    } else {
      add(a, ab, ca);
      add(ab, b, bc);
      add(ca, bc, c);
      add(ab, bc, ca);
    }
  }
  cut.interfaces = std::move(parts);
}

/// Marks the vertices at which some union of the cells there touches itself: has several fans. Only
/// vertices of the interfaces, or where an edge of theirs goes through the body's surface, come
/// into question.
void mark_pinches(CutBody& cut, const std::vector<std::uint8_t>& candidate) {
  struct Corner {
    std::int32_t vertex;
    std::int32_t cell;
    std::int32_t other;  ///< on the other side; -1: outside
    Face face;
  };
  std::vector<Corner> corners;
  const auto add = [&](const Face& face, std::int32_t cell, std::int32_t other) {
    for (const std::int32_t v : face) {
      if (candidate[v]) corners.push_back({v, cell, other, face});
    }
  };
  for (const auto& part : cut.surface) add(part.corners, part.cell, -1);
  for (const auto& part : cut.interfaces) {
    const auto& [a, b, c] = part.corners;
    add({a, b, c}, part.cells[0], part.cells[1]);
    add({a, c, b}, part.cells[1], part.cells[0]);
  }
  std::ranges::stable_sort(corners, {}, &Corner::vertex);
  std::vector<Face> faces;
  for (std::size_t begin = 0; begin < corners.size();) {
    std::size_t end = begin + 1;
    while (end < corners.size() && corners[end].vertex == corners[begin].vertex) ++end;
    const std::int32_t v = corners[begin].vertex;
    std::vector<std::int32_t> cells;
    for (std::size_t n = begin; n < end; ++n) cells.push_back(corners[n].cell);
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    bool pinch = cells.size() >= kManyCells;
    for (unsigned set = 1; set < 1u << cells.size() && !pinch; ++set) {
      const auto in_set = [&](std::int32_t cell) {
        if (cell < 0) return false;
        const auto k = std::ranges::lower_bound(cells, cell) - cells.begin();
        return (set >> k & 1u) != 0;
      };
      faces.clear();
      for (std::size_t n = begin; n < end; ++n) {
        if (in_set(corners[n].cell) && !in_set(corners[n].other)) faces.push_back(corners[n].face);
      }
      if (is_plain_fan(v, faces)) continue;
      const auto fans = fans_at(v, faces, cut.vertices);
      pinch = std::ranges::any_of(fans, [](std::int32_t fan) { return fan > 0; });
    }
    cut.may_pinch[v] = pinch;
    begin = end;
  }
}

/// Drops vertices that nothing uses, but for the first `kept`.
std::vector<std::int32_t> drop_unused_vertices(CutBody& cut, std::size_t kept) {
  std::vector<std::int32_t> number(cut.vertices.size(), -1);
  std::fill_n(number.begin(), kept, 0);
  const auto use = [&](const Face& face) {
    for (const std::int32_t v : face) number[v] = 0;
  };
  for (const auto& part : cut.surface) use(part.corners);
  for (const auto& part : cut.interfaces) use(part.corners);
  std::int32_t count = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    cut.vertices[count] = cut.vertices[v];
    if (!cut.may_pinch.empty()) cut.may_pinch[count] = cut.may_pinch[v];
    number[v] = count++;
  }
  cut.vertices.resize(count);
  if (!cut.may_pinch.empty()) cut.may_pinch.resize(count);
  const auto renumber = [&](Face& face) {
    for (std::int32_t& v : face) v = number[v];
  };
  for (auto& part : cut.surface) renumber(part.corners);
  for (auto& part : cut.interfaces) renumber(part.corners);
  return number;
}

CutBody attempt(const TriangleMesh& body, const TetMesh& tets,
                std::span<const std::int32_t> region_of_tet, int number, int threads) {
  const double shift = kFirstShift * std::pow(kShiftGrowth, number);
  const auto interfaces =
      interface_faces(tets, region_of_tet, shift, static_cast<std::uint64_t>(number));
  const auto crossings = partition::find_crossings(body, interfaces.mesh, threads);
  const auto region_at = [&](const Vec3& point) { return 1 + region_of_tet[tet_at(tets, point)]; };
  Arrangement arrangement = partition::arrange(body, interfaces, crossings, region_at, threads);

  // A vertex of the interfaces, or where one of their edges meets the body.
  std::vector<std::uint8_t> candidate(arrangement.vertices.size(), 0);
  const std::size_t first_crossing = body.vertices.size() + interfaces.mesh.vertices.size();
  for (std::size_t v = body.vertices.size(); v < candidate.size(); ++v) {
    candidate[v] = v < first_crossing || !crossings.crossings[v - first_crossing].body_edge ? 1 : 0;
  }

  CutBody cut;
  cut.vertices = std::move(arrangement.vertices);
  for (const auto& part : arrangement.body) cut.surface.push_back({part.corners, -1, part.source});
  for (const auto& part : arrangement.interfaces)
    cut.interfaces.push_back({part.corners, {-1, -1}});
  const std::int32_t regions =
      region_of_tet.empty() ? 0 : 1 + *std::ranges::max_element(region_of_tet);
  MeshMaker maker(cut.vertices, candidate);
  Sum total;
  const std::vector<RegionFaces> faces = faces_by_region(arrangement, regions);
  for (std::int32_t r = 0; r < regions; ++r) {
    if (faces[r].faces.empty()) continue;
    const TriangleMesh mesh = maker.mesh_of(faces[r].faces);
    for (const auto& solid : solids_of(mesh)) {
      const auto cell = static_cast<std::int32_t>(cut.cells.size());
      cut.cells.push_back({r, volume_of(mesh, solid)});
      total += cut.cells.back().volume;
      if (!(cut.cells.back().volume > 0)) throw NotGeneric("a part of the body has no volume");
      for (const std::int32_t f : solid) {
        const FaceRef ref = faces[r].refs[f];
        if (ref.is_surface()) {
          cut.surface[ref.part()].cell = cell;
        } else {
          cut.interfaces[ref.part()].cells[ref.side()] = cell;
        }
      }
    }
  }
  const double expected = volume(body);
  if (!(std::abs(total.value() - expected) <= kVolumeTolerance * expected)) {
    throw NotGeneric(fmt::format("the parts fill {} of the body", total.value() / expected));
  }
  split_crowded_edges(cut, candidate);
  cut.may_pinch = std::move(candidate);
  drop_unused_vertices(cut, body.vertices.size());
  const std::vector<std::uint8_t> still_candidate = cut.may_pinch;
  mark_pinches(cut, still_candidate);
  return cut;
}

}  // namespace

CutBody cut_body(const TriangleMesh& body, const TetMesh& tets,
                 std::span<const std::int32_t> region_of_tet, Context& context) {
  for (int number = 0;; ++number) {
    context.stop_if_asked();
    try {
      return attempt(body, tets, region_of_tet, number, context.threads);
    } catch (const NotGeneric& error) {
      if (number + 1 < kAttempts) continue;
      throw MethodFailure(
          fmt::format("modes: no consistent cut of the body by the pieces in {} attempts: {}; try "
                      "another cage (option 'cage_faces')",
                      kAttempts, error.what()));
    }
  }
}

CutBody join_cells(const CutBody& cut, std::span<const std::int32_t> group_of_cell) {
  CutBody joined;
  joined.vertices = cut.vertices;
  std::int32_t groups = 0;
  for (const std::int32_t group : group_of_cell) groups = std::max(groups, group + 1);
  joined.cells.resize(groups);
  std::vector<double> largest(groups, -1);
  std::vector<Sum> volumes(groups);
  for (std::size_t c = 0; c < cut.cells.size(); ++c) {
    const std::int32_t group = group_of_cell[c];
    volumes[group] += cut.cells[c].volume;
    if (cut.cells[c].volume <= largest[group]) continue;
    largest[group] = cut.cells[c].volume;
    joined.cells[group].region = cut.cells[c].region;
  }
  for (std::int32_t g = 0; g < groups; ++g) joined.cells[g].volume = volumes[g].value();
  for (auto part : cut.surface) {
    part.cell = group_of_cell[part.cell];
    joined.surface.push_back(part);
  }
  for (auto part : cut.interfaces) {
    for (std::int32_t& cell : part.cells) cell = group_of_cell[cell];
    if (part.cells[0] != part.cells[1]) joined.interfaces.push_back(part);
  }
  joined.may_pinch = cut.may_pinch;
  std::size_t kept = 0;  // the body's vertices are all on its surface; unused ones go
  drop_unused_vertices(joined, kept);
  const std::vector<std::uint8_t> candidate = joined.may_pinch;
  mark_pinches(joined, candidate);
  return joined;
}

}  // namespace fracbench::modes
