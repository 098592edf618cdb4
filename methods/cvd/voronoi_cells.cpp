#include "methods/cvd/voronoi_cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <voro++/voro++.hh>

#include "methods/cvd/predicates.h"

namespace fracbench::cvd {

namespace {

using Triple = std::array<std::int32_t, 3>;

constexpr const char* kInconsistent = "the sites are too close to a special position for Voro++";

// Corner ordinal of a cell's edge in the raw diagram: the fourth site, or -1 for the box.
struct RawEdge {
  Triple sites;
  std::array<std::int32_t, 2> beyond;
};

// The cells as Voro++ sees them: for each cell its neighbours and its edges.
class VoroDiagram {
 public:
  explicit VoroDiagram(std::size_t count) : neighbours(count) {}

  void add_cell(std::int32_t site, voro::voronoicell_neighbor& cell) {
    std::vector<int> faces_of, corners;
    cell.neighbors(faces_of);
    cell.face_vertices(corners);
    std::map<std::array<int, 2>, int> left;        // directed edge -> neighbour of its face
    std::vector<std::vector<int>> around(cell.p);  // corner -> neighbours
    std::size_t at = 0;
    for (const int neighbour : faces_of) {
      if (neighbour >= 0) neighbours[site].push_back(neighbour);
      const int size = corners[at++];
      for (int m = 0; m < size; ++m) {
        const int from = corners[at + m], to = corners[at + (m + 1) % size];
        left[{from, to}] = neighbour;
        around[from].push_back(neighbour);
      }
      at += size;
    }
    std::ranges::sort(neighbours[site]);
    for (const auto& [ends, j] : left) {
      const auto opposite = left.find({ends[1], ends[0]});
      if (opposite == left.end()) throw Degenerate(kInconsistent);
      const int k = opposite->second;
      if (j < 0 || k < 0 || ends[0] > ends[1]) continue;
      RawEdge edge{{site, j, k}, {beyond(around[ends[0]], j, k), beyond(around[ends[1]], j, k)}};
      std::ranges::sort(edge.sites);
      std::ranges::sort(edge.beyond);
      edges.push_back(edge);
    }
  }

  std::vector<std::vector<std::int32_t>> neighbours;
  std::vector<RawEdge> edges;

 private:
  static std::int32_t beyond(const std::vector<int>& around, int j, int k) {
    std::int32_t other = -2;
    for (const int site : around) {
      if (site < 0) return -1;
      if (site == j || site == k) continue;
      if (other != -2) throw Degenerate(kInconsistent);
      other = site;
    }
    if (other == -2) throw Degenerate(kInconsistent);
    return other;
  }
};

VoroDiagram run_voro(std::span<const Vec3> sites, const BoundingBox& body) {
  BoundingBox box = body;
  for (const Vec3& site : sites) {
    box.low = box.low.cwiseMin(site);
    box.high = box.high.cwiseMax(site);
  }
  // Voro++ has absolute tolerances made for lengths around one. The margin keeps the box's walls
  // off the body.
  const Vec3 center = box.center();
  const double scale = body.longest_side();
  const Vec3 half = (box.high - box.low) / (2 * scale) + Vec3::Constant(0.5);
  const int blocks = std::max(1, static_cast<int>(std::cbrt(sites.size() / 5.0)));
  voro::container container(-half[0], half[0], -half[1], half[1], -half[2], half[2], blocks, blocks,
                            blocks, false, false, false, 8);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Vec3 p = (sites[i] - center) / scale;
    container.put(static_cast<int>(i), p[0], p[1], p[2]);
  }
  VoroDiagram diagram(sites.size());
  voro::c_loop_all loop(container);
  voro::voronoicell_neighbor cell;
  std::size_t found = 0;
  if (loop.start()) {
    do {
      if (!container.compute_cell(cell, loop)) throw Degenerate(kInconsistent);
      diagram.add_cell(loop.pid(), cell);
      ++found;
    } while (loop.inc());
  }
  if (found != sites.size()) throw Degenerate(kInconsistent);
  return diagram;
}

}  // namespace

VoronoiCells voronoi_cells(std::span<const Vec3> sites, const BoundingBox& body) {
  VoroDiagram raw = run_voro(sites, body);
  VoronoiCells cells;
  cells.sites.assign(sites.begin(), sites.end());
  cells.neighbours = std::move(raw.neighbours);

  std::ranges::sort(raw.edges, [](const RawEdge& a, const RawEdge& b) {
    return std::tie(a.sites, a.beyond) < std::tie(b.sites, b.beyond);
  });
  std::map<std::array<std::int32_t, 4>, std::int32_t> vertex_of;
  for (const RawEdge& edge : raw.edges) {
    for (const std::int32_t site : edge.beyond) {
      if (site < 0) continue;
      std::array<std::int32_t, 4> key{edge.sites[0], edge.sites[1], edge.sites[2], site};
      std::ranges::sort(key);
      vertex_of.emplace(key, 0);
    }
  }
  for (auto& [key, number] : vertex_of) {
    number = static_cast<std::int32_t>(cells.vertices.size());
    cells.vertices.push_back({key});
  }

  for (std::size_t e = 0; e < raw.edges.size(); e += 3) {
    // Each of the three cells around an edge must have seen the same one.
    const RawEdge& edge = raw.edges[e];
    for (std::size_t copy = 0; copy < 4; ++copy) {
      const bool same = e + copy < raw.edges.size() && raw.edges[e + copy].sites == edge.sites &&
                        raw.edges[e + copy].beyond == edge.beyond;
      if (same != (copy < 3)) throw Degenerate(kInconsistent);
    }
    if (e + 3 < raw.edges.size() && raw.edges[e + 3].sites == edge.sites) {
      throw Degenerate(kInconsistent);
    }
    const auto& [i, j, k] = edge.sites;
    VoronoiCells::Edge directed{edge.sites};
    for (const std::int32_t site : edge.beyond) {
      if (site < 0) continue;
      std::array<std::int32_t, 4> key{i, j, k, site};
      std::ranges::sort(key);
      // Along the edge one comes from the site at its start and goes to the one at its end.
      const bool is_end = orientation(sites[i], sites[j], sites[k], sites[site]) > 0;
      std::int32_t& end = is_end ? directed.end : directed.start;
      if (end >= 0) throw Degenerate(kInconsistent);
      end = vertex_of.at(key);
    }
    if (edge.beyond[0] >= 0 && edge.beyond[1] >= 0 &&
        side_of_sphere(sites[i], sites[j], sites[k], sites[edge.beyond[0]], sites[edge.beyond[1]]) <
            0) {
      throw Degenerate(kInconsistent);
    }
    cells.edges.push_back(directed);
  }
  return cells;
}

}  // namespace fracbench::cvd
