#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/error.h"
#include "methods/bem/cracked_surface.h"
#include "methods/bem/refit_sheet.h"

namespace fracbench::bem {
namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;

struct Place {
  double x, y, z;
  auto operator<=>(const Place&) const = default;
};
Place place(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// Which of a vertex's triangles still hang together once the surface is open along `cut`.
class Sectors {
 public:
  Sectors(const TriangleMesh& surface, const std::map<Edge, std::int32_t>& face_of,
          const std::map<Edge, bool>& cut, const std::vector<char>& closed)
      : surface_(surface), parent_(3 * surface.faces.size()) {
    for (std::size_t i = 0; i < parent_.size(); ++i) parent_[i] = static_cast<std::int32_t>(i);
    for (const auto& [edge, face] : face_of) {
      const auto [a, b] = edge;
      const auto other = face_of.find({b, a});
      if (a > b || other == face_of.end()) continue;
      const bool open = cut.contains(std::minmax(a, b));
      for (const std::int32_t v : {a, b}) {
        if (!open || closed[v] != 0) join(corner(face, v), corner(other->second, v));
      }
    }
  }

  /// The triangle corner that stands for all corners in the sector of `face` at `vertex`.
  std::int32_t sector(std::int32_t face, std::int32_t vertex) { return find(corner(face, vertex)); }

 private:
  std::int32_t corner(std::int32_t face, std::int32_t vertex) const {
    const Face& f = surface_.faces[face];
    return 3 * face + (f[0] == vertex ? 0 : f[1] == vertex ? 1 : 2);
  }
  std::int32_t find(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  const TriangleMesh& surface_;
  std::vector<std::int32_t> parent_;
};

/// A boundary edge of a sheet that lies in the surface.
struct MouthEdge {
  std::int32_t sheet;
  std::array<std::int32_t, 2> ends;          ///< vertices of the sheet, along the boundary
  std::array<std::int32_t, 2> surface_ends;  ///< vertices of the surface
};

std::vector<MouthEdge> find_mouth_edges(const TriangleMesh& surface,
                                        std::span<const CrackSheet> sheets,
                                        const std::map<Edge, std::int32_t>& face_of) {
  std::map<Place, std::int32_t> vertex_at;
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    vertex_at.emplace(place(surface.vertices[v]), static_cast<std::int32_t>(v));
  }
  std::vector<MouthEdge> edges;
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    const std::vector<std::int32_t>& boundary = sheets[s].boundary;
    for (std::size_t i = 0; i < boundary.size(); ++i) {
      const std::int32_t a = boundary[i];
      const std::int32_t b = boundary[(i + 1) % boundary.size()];
      const auto at_a = vertex_at.find(place(sheets[s].mesh.vertices[a]));
      const auto at_b = vertex_at.find(place(sheets[s].mesh.vertices[b]));
      if (at_a == vertex_at.end() || at_b == vertex_at.end()) continue;
      if (!face_of.contains({at_a->second, at_b->second})) continue;
      if (!face_of.contains({at_b->second, at_a->second})) continue;
      edges.push_back({static_cast<std::int32_t>(s), {a, b}, {at_a->second, at_b->second}});
    }
  }
  return edges;
}

}  // namespace

CrackedSurface split_mouths(const TriangleMesh& surface, std::span<const CrackSheet> sheets) {
  std::map<Edge, std::int32_t> face_of;  // the face to the left of each directed edge
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      face_of[{surface.faces[f][k], surface.faces[f][(k + 1) % 3]}] = static_cast<std::int32_t>(f);
    }
  }
  const std::vector<MouthEdge> edges = find_mouth_edges(surface, sheets, face_of);
  std::map<Edge, bool> cut;
  for (const MouthEdge& edge : edges) {
    cut[std::minmax(edge.surface_ends[0], edge.surface_ends[1])] = true;
  }
  std::vector<char> meeting(surface.vertices.size(), 0);  // more than one mouth, or one with itself
  std::vector<int> edges_at(surface.vertices.size(), 0);
  std::vector<std::int32_t> sheet_at(surface.vertices.size(), -1);
  for (const MouthEdge& edge : edges) {
    for (const std::int32_t v : edge.surface_ends) {
      if (++edges_at[v] > 2 || (sheet_at[v] >= 0 && sheet_at[v] != edge.sheet)) meeting[v] = 1;
      sheet_at[v] = edge.sheet;
    }
  }
  Sectors sectors(surface, face_of, cut, meeting);

  CrackedSurface result;
  result.surface = surface;
  result.sheets.assign(sheets.begin(), sheets.end());
  // One vertex for each sector: the first one met keeps the old vertex.
  std::vector<std::int32_t> first_sector(surface.vertices.size(), -1);
  std::map<std::int32_t, std::int32_t> vertex_of_sector;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t old = surface.faces[f][k];
      const std::int32_t sector = sectors.sector(static_cast<std::int32_t>(f), old);
      if (first_sector[old] < 0) {
        first_sector[old] = sector;
        vertex_of_sector[sector] = old;
      }
      const auto [at, fresh] = vertex_of_sector.try_emplace(
          sector, static_cast<std::int32_t>(result.surface.vertices.size()));
      if (fresh) result.surface.vertices.push_back(surface.vertices[old]);
      result.surface.faces[f][k] = at->second;
    }
  }

  // The sheet lies to the left of its boundary, seen from above, and inside the body: the surface's
  // triangle to the left of the same way, seen from outside, is on the upper side.
  std::map<std::pair<std::int32_t, std::int32_t>, MouthVertex> mouths;
  for (const MouthEdge& edge : edges) {
    const auto [a, b] = edge.surface_ends;
    const auto upper_at = face_of.find({a, b});
    const auto lower_at = face_of.find({b, a});
    if (upper_at == face_of.end() || lower_at == face_of.end()) {
      throw MethodFailure("the surface is not closed at a crack's mouth");
    }
    const std::int32_t upper_face = upper_at->second;
    const std::int32_t lower_face = lower_at->second;
    for (int end = 0; end < 2; ++end) {
      const std::int32_t v = edge.surface_ends[end];
      const std::int32_t upper = vertex_of_sector.at(sectors.sector(upper_face, v));
      const std::int32_t lower = vertex_of_sector.at(sectors.sector(lower_face, v));
      // The edge before and the one after give the same.
      mouths.try_emplace({edge.sheet, edge.ends[end]},
                         MouthVertex{edge.sheet, edge.ends[end], upper, lower});
    }
  }
  std::vector<bool> has_mouth(sheets.size(), false);
  for (const auto& [key, mouth] : mouths) {
    result.mouths.push_back(mouth);
    has_mouth[mouth.sheet] = true;
  }
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    if (!has_mouth[s] && !mouth_runs(sheets[s]).empty()) ++result.overshooting;
  }
  return result;
}

}  // namespace fracbench::bem
