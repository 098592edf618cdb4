#include "methods/cvd/cut_surface.h"

#include <algorithm>
#include <span>
#include <unordered_map>

#include "core/parallel.h"
#include "methods/cvd/clip_triangle.h"
#include "methods/cvd/predicates.h"

namespace fracbench::cvd {

namespace {

// A mesh vertex must be clear of the bisectors by this share of the body's scale: a thousand times
// the rounding of a coordinate, so that no sliver between them is lost.
constexpr double kClearance = 1e-13;
// Relative error of h_ij in double precision, as a share of |p_j - p_i| times the extent.
constexpr double kRounding = 4e-15;

constexpr std::size_t kChunk = 256;

// Walks from cell to nearer neighbouring cell; in a Voronoi diagram that ends at the right one.
class OwnerSearch {
 public:
  OwnerSearch(const VoronoiCells& cells, const SurfaceTopology& body)
      : cells_(cells), clearance_(cells.neighbours.size()) {
    BoundingBox all = body.box;
    for (const Vec3& site : cells.sites) {
      all.low = all.low.cwiseMin(site);
      all.high = all.high.cwiseMax(site);
    }
    const double distance =
        std::max(kClearance * body.scale, kRounding * (all.high - all.low).norm());
    for (std::size_t i = 0; i < clearance_.size(); ++i) {
      for (const std::int32_t j : cells.neighbours[i]) {
        clearance_[i].push_back(2 * distance * (cells.sites[j] - cells.sites[i]).norm());
      }
    }
  }

  std::int32_t find(const Vec3& x, std::int32_t start) const {
    for (std::int32_t i = start;;) {
      std::int32_t next = -1;
      double worst = 0;
      bool close = false;
      for (std::size_t n = 0; n < cells_.neighbours[i].size(); ++n) {
        const std::int32_t j = cells_.neighbours[i][n];
        const Vec3& p = cells_.sites[i];
        const Vec3& q = cells_.sites[j];
        const double h = (q - p).dot((x - p) + (x - q));
        close |= h > -clearance_[i][n];
        if (h > clearance_[i][n] && h > worst) {
          worst = h;
          next = j;
        }
      }
      if (next >= 0) {
        i = next;
      } else if (close) {
        throw Degenerate("a vertex of the body lies between two cells");
      } else {
        return i;
      }
    }
  }

 private:
  const VoronoiCells& cells_;
  std::vector<std::vector<double>> clearance_;
};

std::vector<std::int32_t> owners(const SurfaceTopology& body, const VoronoiCells& cells,
                                 int threads) {
  const OwnerSearch search(cells, body);
  const auto& vertices = body.mesh.vertices;
  std::vector<std::uint8_t> used(vertices.size());
  for (const Face& face : body.mesh.faces) {
    for (const std::int32_t v : face) used[v] = 1;
  }
  std::vector<std::int32_t> owner(vertices.size(), -1);
  parallel_for((vertices.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    std::int32_t near = 0;
    for (std::size_t v = chunk * kChunk; v < std::min(vertices.size(), (chunk + 1) * kChunk); ++v) {
      if (used[v]) owner[v] = near = search.find(vertices[v], near);
    }
  });
  return owner;
}

struct VertexHash {
  std::size_t operator()(const SurfaceVertex& v) const {
    std::uint64_t hash = static_cast<std::uint32_t>(v.place);
    for (const std::int32_t site : v.sites) {
      hash = (hash ^ static_cast<std::uint32_t>(site)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

// Turns the lines that bound a polygon into its named corners.
SurfaceVertex name_of_corner(const SurfaceTopology& body, std::int32_t face, std::int32_t cell,
                             std::int32_t p, std::int32_t q) {
  SurfaceVertex vertex;
  if (p >= 0 && q >= 0) {
    vertex.place = face;
    vertex.sites = {cell, p, q};
    std::ranges::sort(vertex.sites);
  } else {
    vertex.place = body.face_edges[face][-1 - std::min(p, q)];
    const std::int32_t other = std::max(p, q);
    vertex.sites = {std::min(cell, other), std::max(cell, other), -1};
  }
  return vertex;
}

}  // namespace

SurfaceCut cut_surface(const SurfaceTopology& body, const VoronoiCells& cells, int threads) {
  SurfaceCut cut;
  cut.owner = owners(body, cells, threads);
  const auto& faces = body.mesh.faces;
  std::vector<std::int32_t> divided;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [a, b, c] = faces[f];
    if (cut.owner[a] != cut.owner[b] || cut.owner[a] != cut.owner[c]) {
      divided.push_back(static_cast<std::int32_t>(f));
    }
  }
  std::vector<std::vector<ClippedTriangle>> parts(divided.size());
  parallel_for(
      divided.size(), threads,
      [&](std::size_t d) {
        const Face& face = faces[divided[d]];
        const auto& v = body.mesh.vertices;
        parts[d] = clip_triangle(cells, {v[face[0]], v[face[1]], v[face[2]]},
                                 {cut.owner[face[0]], cut.owner[face[1]], cut.owner[face[2]]});
      },
      32);

  const auto first_new = static_cast<std::int32_t>(body.mesh.vertices.size());
  std::unordered_map<SurfaceVertex, std::int32_t, VertexHash> number_of;
  number_of.reserve(4 * divided.size());
  cut.polygons.reserve(faces.size() + 2 * divided.size());
  cut.corners.reserve(3 * faces.size() + 8 * divided.size());
  cut.lines.reserve(cut.corners.capacity());
  for (std::size_t f = 0, d = 0; f < faces.size(); ++f) {
    const auto face = static_cast<std::int32_t>(f);
    const auto first = static_cast<std::int32_t>(cut.corners.size());
    if (d == divided.size() || divided[d] != face) {
      cut.polygons.push_back({face, cut.owner[faces[f][0]], first, 3});
      cut.corners.insert(cut.corners.end(), faces[f].begin(), faces[f].end());
      cut.lines.insert(cut.lines.end(), 3, -1);
      continue;
    }
    for (const auto& [cell, lines] : parts[d]) {
      const std::size_t size = lines.size();
      cut.polygons.push_back({face, cell, static_cast<std::int32_t>(cut.corners.size()),
                              static_cast<std::int32_t>(size)});
      for (std::size_t n = 0; n < size; ++n) {
        const std::int32_t p = lines[(n + size - 1) % size], q = lines[n];
        cut.lines.push_back(q >= 0 ? q : -1);
        if (p < 0 && q < 0) {
          cut.corners.push_back(faces[f][-1 - q]);
          continue;
        }
        const SurfaceVertex vertex = name_of_corner(body, face, cell, p, q);
        const auto [entry, fresh] = number_of.try_emplace(
            vertex, first_new + static_cast<std::int32_t>(cut.vertices.size()));
        if (fresh) cut.vertices.push_back(vertex);
        cut.corners.push_back(entry->second);
      }
    }
    ++d;
  }
  return cut;
}

}  // namespace fracbench::cvd
