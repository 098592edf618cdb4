#include "methods/cvd/cut_cracks.h"

#include <algorithm>
#include <map>

#include "methods/cvd/predicates.h"
#include "methods/cvd/winding.h"

namespace fracbench::cvd {

namespace {

// Crossings of a Voronoi edge with the surface must be this far apart, as a share of the body's
// scale, to be put in order.
constexpr double kApart = 1e-14;

struct Crossing {
  std::int32_t vertex;
  double along;  // the Voronoi edge, m
  bool leaving;  // the body, in the edge's direction
};

enum class Place : std::int8_t { unknown, outside, inside };

// The Voronoi edges with their crossings, and which Voronoi vertices lie within the body.
class InnerEdges {
 public:
  InnerEdges(const SurfaceTopology& body, const VoronoiCells& cells, const SurfaceCut& surface,
             const std::vector<Vec3>& vertices)
      : cells_(cells), crossings_(cells.edges.size()), place_(cells.vertices.size()) {
    collect_crossings(body, surface, vertices);
    sort_crossings(kApart * body.scale);
    place_vertices(body);
  }

  bool is_inside(std::size_t vertex) const { return place_[vertex] == Place::inside; }

  // Calls use(from, to) for the parts of an edge within the body, in its direction.
  template <typename Number, typename Use>
  void for_each_part(std::size_t edge, const Number& number_of_vertex, const Use& use) const {
    const VoronoiCells::Edge& e = cells_.edges[edge];
    std::int32_t from = -1;
    if (e.start >= 0 && is_inside(e.start)) from = number_of_vertex(e.start);
    for (const Crossing& crossing : crossings_[edge]) {
      if (crossing.leaving != (from >= 0)) throw Degenerate(kMisordered);
      if (crossing.leaving) use(from, crossing.vertex);
      from = crossing.leaving ? -1 : crossing.vertex;
    }
    const bool ends_inside = e.end >= 0 && is_inside(e.end);
    if (ends_inside != (from >= 0)) throw Degenerate(kMisordered);
    if (ends_inside) use(from, number_of_vertex(e.end));
  }

 private:
  static constexpr const char* kMisordered =
      "a Voronoi edge does not enter and leave the body in turn";

  Vec3 direction(const VoronoiCells::Edge& edge) const {
    const auto& [i, j, k] = edge.sites;
    const Vec3& p = cells_.sites[i];
    return (cells_.sites[j] - p).cross(cells_.sites[k] - p).normalized();
  }

  void collect_crossings(const SurfaceTopology& body, const SurfaceCut& surface,
                         const std::vector<Vec3>& vertices) {
    const auto first = static_cast<std::int32_t>(body.mesh.vertices.size());
    for (std::size_t n = 0; n < surface.vertices.size(); ++n) {
      const SurfaceVertex& vertex = surface.vertices[n];
      if (vertex.on_edge()) continue;
      const auto found =
          std::ranges::lower_bound(cells_.edges, vertex.sites, {}, &VoronoiCells::Edge::sites);
      if (found == cells_.edges.end() || found->sites != vertex.sites) {
        throw Degenerate("the surface meets a Voronoi edge that Voro++ did not find");
      }
      const Face& face = body.mesh.faces[vertex.place];
      const Corners corners{body.mesh.vertices[face[0]], body.mesh.vertices[face[1]],
                            body.mesh.vertices[face[2]]};
      const auto& [i, j, k] = vertex.sites;
      const auto number = first + static_cast<std::int32_t>(n);
      crossings_[found - cells_.edges.begin()].push_back(
          {number, direction(*found).dot(vertices[number] - cells_.sites[i]),
           axis_side(cells_.sites[i], cells_.sites[j], cells_.sites[k], corners) > 0});
    }
  }

  void sort_crossings(double apart) {
    for (auto& list : crossings_) {
      std::ranges::sort(list, {}, &Crossing::along);
      for (std::size_t n = 1; n < list.size(); ++n) {
        if (list[n].along - list[n - 1].along < apart) {
          throw Degenerate("a Voronoi edge meets the surface twice at one place");
        }
      }
    }
  }

  // What an edge says of its two ends, given what is known of the other.
  void place_vertices(const SurfaceTopology& body) {
    std::vector<std::vector<std::int32_t>> edges_at(cells_.vertices.size());
    std::vector<std::int32_t> known;
    const auto settle = [&](std::int32_t vertex, bool inside) {
      if (vertex < 0 || place_[vertex] != Place::unknown) return;
      place_[vertex] = inside ? Place::inside : Place::outside;
      known.push_back(vertex);
    };
    for (std::size_t e = 0; e < cells_.edges.size(); ++e) {
      const auto& edge = cells_.edges[e];
      for (const std::int32_t end : {edge.start, edge.end}) {
        if (end >= 0) edges_at[end].push_back(static_cast<std::int32_t>(e));
      }
      if (!crossings_[e].empty()) {
        settle(edge.start, crossings_[e].front().leaving);
        settle(edge.end, !crossings_[e].back().leaving);
      } else if (edge.start < 0 || edge.end < 0) {
        settle(edge.start, false);
        settle(edge.end, false);
      }
    }
    for (std::size_t seed = 0;; ++seed) {
      while (!known.empty()) {
        const std::int32_t vertex = known.back();
        known.pop_back();
        for (const std::int32_t e : edges_at[vertex]) {
          if (!crossings_[e].empty()) continue;
          settle(cells_.edges[e].start, is_inside(vertex));
          settle(cells_.edges[e].end, is_inside(vertex));
        }
      }
      while (seed < place_.size() && place_[seed] != Place::unknown) ++seed;
      if (seed >= place_.size()) return;
      const auto& [i, j, k, l] = cells_.vertices[seed].sites;
      const Vec3 point =
          voronoi_vertex(cells_.sites[i], cells_.sites[j], cells_.sites[k], cells_.sites[l]);
      settle(static_cast<std::int32_t>(seed), winding_number(body.mesh, point) > 0.5);
    }
  }

  const VoronoiCells& cells_;
  std::vector<std::vector<Crossing>> crossings_;
  std::vector<Place> place_;
};

}  // namespace

CrackOutlines crack_outlines(const SurfaceTopology& body, const VoronoiCells& cells,
                             const SurfaceCut& surface, const std::vector<Vec3>& vertices) {
  std::map<std::array<std::int32_t, 2>, std::vector<BoundaryEdge>> outlines;
  for (const SurfaceCut::Polygon& polygon : surface.polygons) {
    for (std::int32_t n = 0; n < polygon.size; ++n) {
      const std::int32_t other = surface.lines[polygon.first + n];
      if (other <= polygon.cell) continue;  // -1, or seen from the other side
      const std::int32_t from = surface.corners[polygon.first + n];
      const std::int32_t to = surface.corners[polygon.first + (n + 1) % polygon.size];
      outlines[{polygon.cell, other}].push_back({to, from});
    }
  }

  const InnerEdges inner(body, cells, surface, vertices);
  CrackOutlines result;
  std::vector<std::int32_t> number(cells.vertices.size(), -1);
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (!inner.is_inside(v)) continue;
    number[v] = static_cast<std::int32_t>(vertices.size() + result.inner_vertices.size());
    result.inner_vertices.push_back(static_cast<std::int32_t>(v));
  }
  for (std::size_t e = 0; e < cells.edges.size(); ++e) {
    const auto& sites = cells.edges[e].sites;
    const std::int32_t i = sites[0], j = sites[1], k = sites[2];
    // The edge runs counter-clockwise around the face (i, j) seen from j; a swap of two sites
    // turns it.
    inner.for_each_part(
        e, [&](std::int32_t v) { return number[v]; },
        [&](std::int32_t from, std::int32_t to) {
          outlines[{i, j}].push_back({from, to});
          outlines[{i, k}].push_back({to, from});
          outlines[{j, k}].push_back({from, to});
        });
  }
  for (auto& [pair, edges] : outlines) result.outlines.push_back({pair, std::move(edges)});
  return result;
}

}  // namespace fracbench::cvd
