#include "geometry/partition/interfaces.h"

#include <algorithm>
#include <unordered_map>

#include "core/parallel.h"
#include "geometry/partition/cell_points.h"
#include "geometry/partition/kuhn_cell.h"

namespace fracbench::partition {
namespace {

// Points on lattice edges stay this far from their ends.
constexpr double edge_margin = 0.1;
// Least barycentric coordinate of vertices in tetrahedra and their sides.
constexpr double simplex_margin = 0.04;
// Tiny displacement of every vertex, in cells: far less than any margin.
constexpr double displacement = 1e-5;
// Determinants of points in a cell below this count as 0, in cells^3.
constexpr double flat = 1e-6;

Vec3 step_vector(int bits) { return Vec3(bits & 1, bits >> 1 & 1, bits >> 2 & 1); }

/// What a corner set looks like: up to four regions, as masks of corners.
struct CellRegions {
  std::array<std::int32_t, 8> region;
  std::array<std::uint8_t, 8> mask;
  int count = 0;

  explicit CellRegions(const std::array<std::int32_t, 8>& corners) : region{}, mask{} {
    for (int c = 0; c < 8; ++c) {
      int r = 0;
      while (r < count && region[r] != corners[c]) ++r;
      if (r == count) region[count++] = corners[c];
      mask[r] = static_cast<std::uint8_t>(mask[r] | 1 << c);
    }
  }
  int solid_count() const {
    int solids = 0;
    for (int r = 0; r < count; ++r) solids += region[r] != 0;
    return solids;
  }
  /// Every way to divide the regions in two gives one disc.
  bool is_simple(const KuhnTables& tables) const {
    if (count > 4) return false;
    for (int subset = 1; subset < 1 << (count - 1); ++subset) {
      int corners = 0;
      for (int r = 0; r < count; ++r) {
        if (subset >> r & 1) corners |= mask[r];
      }
      if (!tables.simple[corners]) return false;
    }
    return true;
  }
};

class Extraction {
 public:
  Extraction(const LabelLattice& lattice, const InterfaceOptions& options)
      : grid_(lattice.region), options_(options), tables_(kuhn_tables()) {
    for (int c = 0; c < 8; ++c) step_[c] = grid_.index(c & 1, c >> 1 & 1, c >> 2 & 1);
  }

  InterfaceMesh run() {
    find_cells();
    smooth();
    emit();
    return std::move(result_);
  }

 private:
  static constexpr std::int32_t uniform = -1;

  /// A cell with several regions. An ambiguous one has no vertex of its own; those in its
  /// tetrahedra are drawn to its place.
  struct Node {
    std::size_t cell = 0;
    std::int32_t vertex = -1;  ///< -1: the cell is ambiguous
  };

  std::array<std::int32_t, 8> corners(std::size_t cell) const {
    std::array<std::int32_t, 8> result;
    for (int c = 0; c < 8; ++c) result[c] = grid_.values[cell + step_[c]];
    return result;
  }

  void find_cells() {
    const auto slabs = static_cast<std::size_t>(grid_.size[2] - 1);
    std::vector<std::vector<std::size_t>> mixed(slabs);
    parallel_for(
        slabs, options_.threads,
        [&](std::size_t k) {
          for (int j = 0; j + 1 < grid_.size[1]; ++j) {
            std::size_t cell = grid_.index(0, j, static_cast<int>(k));
            // A column of four samples, x fixed: whether it is uniform, and its first region.
            const auto column_uniform = [&](std::size_t s) {
              const std::int32_t r = grid_.values[s];
              return grid_.values[s + step_[2]] == r && grid_.values[s + step_[4]] == r &&
                     grid_.values[s + step_[6]] == r;
            };
            bool left = column_uniform(cell);
            for (int i = 0; i + 1 < grid_.size[0]; ++i, ++cell) {
              const bool right = column_uniform(cell + 1);
              if (!left || !right || grid_.values[cell] != grid_.values[cell + 1]) {
                mixed[k].push_back(cell);
              }
              left = right;
            }
          }
        },
        4);
    cell_node_.assign(grid_.values.size(), uniform);
    std::int32_t simple_cells = 0;
    for (const auto& slab : mixed) {
      for (const std::size_t cell : slab) {
        const CellRegions regions(corners(cell));
        if (!options_.with_void && regions.solid_count() < 2) continue;
        cell_node_[cell] = static_cast<std::int32_t>(nodes_.size());
        Node node;
        node.cell = cell;
        if (regions.is_simple(tables_)) {
          node.vertex = simple_cells++;
        } else {
          ++result_.ambiguous_cells;
        }
        nodes_.push_back(node);
      }
    }
  }

  /// Where the interfaces cross the cell's edges, on average, and which neighbours pull at it:
  /// along a junction of three regions only those on the same junction.
  CellPoint make_point(const Node& node) const {
    CellPoint point;
    const auto corner = corners(node.cell);
    const int solids = CellRegions(corner).solid_count();
    int crossings = 0;
    for (int c = 0; c < 8; ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        const int other = c | 1 << axis;
        if (other == c || corner[c] == corner[other]) continue;
        if (solids > 1 && (corner[c] == 0 || corner[other] == 0)) continue;
        point.place += (step_vector(c) + step_vector(other)) / 2;
        ++crossings;
      }
    }
    point.place = crossings > 0 ? Vec3(point.place / crossings) : Vec3::Constant(0.5);

    int pulls = 0;
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
      const int base = side % 2 ? 1 << axis : 0;
      const std::array<std::int32_t, 4> on_side = {corner[base], corner[base | u], corner[base | v],
                                                   corner[base | u | v]};
      int distinct = 0;
      for (int n = 0; n < 4; ++n) {
        distinct += on_side[n] != 0 && std::find(on_side.begin(), on_side.begin() + n,
                                                 on_side[n]) == on_side.begin() + n;
      }
      if (distinct < 2 || (solids > 2 && distinct < 3)) continue;
      const std::size_t step = step_[1 << axis];
      const std::int32_t neighbour = cell_node_[side % 2 ? node.cell + step : node.cell - step];
      if (neighbour < 0) continue;
      point.neighbours[side] = neighbour;
      ++pulls;
    }
    point.movable = pulls >= 2;
    return point;
  }

  void smooth() {
    points_.resize(nodes_.size());
    parallel_for(
        nodes_.size(), options_.threads, [&](std::size_t n) { points_[n] = make_point(nodes_[n]); },
        1024);
    smooth_points(points_, options_.smoothing_steps, options_.threads);
  }

  Vec3 sample_position(std::size_t sample) const {
    const auto nx = static_cast<std::size_t>(grid_.size[0]);
    const auto ny = static_cast<std::size_t>(grid_.size[1]);
    return Vec3(static_cast<double>(sample % nx), static_cast<double>(sample / nx % ny),
                static_cast<double>(sample / (nx * ny)));
  }

  /// Three numbers in [-1, 1) that depend on the vertex's key and the salt only (splitmix64).
  Vec3 noise(std::uint64_t key) const {
    Vec3 result;
    const std::uint64_t state = key * 3 + options_.salt * 0x632be59bd9b4e019ull;
    for (int axis = 0; axis < 3; ++axis) {
      std::uint64_t z = (state + static_cast<std::uint64_t>(axis) + 1) * 0x9e3779b97f4a7c15ull;
      z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ull;
      z = (z ^ z >> 27) * 0x94d049bb133111ebull;
      z ^= z >> 31;
      result[axis] = static_cast<double>(z >> 11) * 0x1.0p-52 - 1;
    }
    return result;
  }

  // Every vertex has a key, 32 * (index of a sample) + what it is there: 0 to 5 in a tetrahedron,
  // 8 + step on an edge, 16 + kind in a side of a tetrahedron, 31 in the whole cell.
  static std::uint64_t key(std::size_t sample, int what) {
    return 32 * static_cast<std::uint64_t>(sample) + static_cast<std::uint64_t>(what);
  }

  /// `local` is in units of the grid, relative to its origin.
  std::int32_t add_vertex(std::uint64_t vertex_key, const Vec3& local) {
    local_.push_back(local + displacement * noise(vertex_key));
    return static_cast<std::int32_t>(local_.size() - 1);
  }

  /// The same vertex each time it is asked for.
  std::int32_t shared_vertex(std::uint64_t vertex_key, const Vec3& local) {
    const auto [at, added] = shared_.try_emplace(vertex_key, 0);
    if (added) at->second = add_vertex(vertex_key, local);
    return at->second;
  }

  /// Of a node, in cells from the grid's origin.
  Vec3 place_of(std::int32_t node) const {
    return sample_position(nodes_[node].cell) + points_[node].place;
  }

  /// The vertex in the side between the tetrahedra of two steps.
  std::int32_t side_vertex(std::size_t start, const RingStep& step, std::int32_t here,
                           std::int32_t next) {
    const std::size_t base = start - step_[step.triangle_base];
    const auto& steps = tables_.triangle_steps[step.triangle_kind];
    const Vec3 origin = sample_position(base), u = step_vector(steps[0]), v = step_vector(steps[1]);
    const Vec3 wish = (place_of(here) + place_of(next)) / 2 - origin;
    // Barycentric coordinates of the wish's projection.
    const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = wish.dot(u), wv = wish.dot(v);
    const double determinant = uu * vv - uv * uv;
    Vec3 weights(0, (wu * vv - wv * uv) / determinant, (wv * uu - wu * uv) / determinant);
    weights[0] = 1 - weights[1] - weights[2];
    weights = weights.cwiseMax(simplex_margin).eval();
    weights /= weights.sum();
    return shared_vertex(key(base, 16 + step.triangle_kind),
                         origin + weights[1] * u + weights[2] * v);
  }

  std::int32_t tetrahedron_vertex(std::int32_t node, int tetrahedron) {
    const std::size_t cell = nodes_[node].cell;
    const auto& chain = tables_.tetrahedron[tetrahedron];
    // Along a chain of corners, each adds a step along one axis.
    Eigen::Vector4d weights(1, 0, 0, 0);
    for (int n = 1; n < 4; ++n) {
      const double x = step_vector(chain[n] ^ chain[n - 1]).dot(points_[node].place);
      weights[n - 1] -= x;
      weights[n] = x;
    }
    weights = weights.cwiseMax(simplex_margin).eval();
    weights /= weights.sum();
    Vec3 place = sample_position(cell);
    for (int n = 1; n < 4; ++n) place += weights[n] * step_vector(chain[n]);
    return shared_vertex(key(cell, tetrahedron), place);
  }

  void emit() {
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (nodes_[n].vertex < 0) continue;
      add_vertex(key(nodes_[n].cell, 31), place_of(static_cast<std::int32_t>(n)));
    }
    for (const Node& node : nodes_) {
      const std::size_t cell = node.cell;
      const std::int32_t below = grid_.values[cell];
      for (int d = 1; d < 8; ++d) {
        const std::int32_t above = grid_.values[cell + step_[d]];
        if (below == above) continue;
        if (!options_.with_void && (below == 0 || above == 0)) continue;
        emit_polygon(cell, d, {below, above});
      }
    }
    TriangleMesh& mesh = result_.mesh;
    mesh.vertices.reserve(local_.size());
    for (const Vec3& p : local_) mesh.vertices.push_back(grid_.origin + grid_.spacing * p);
  }

  void emit_polygon(std::size_t start, int d, const std::array<std::int32_t, 2>& sides) {
    const auto& ring = tables_.ring[d];
    polygon_.clear();
    bool simple = true;
    for (std::size_t n = 0; n < ring.size(); ++n) {
      const RingStep& next = ring[(n + 1) % ring.size()];
      const std::int32_t here = cell_node_[start - step_[ring[n].cell]];
      const std::int32_t beyond = cell_node_[start - step_[next.cell]];
      const bool ambiguous = nodes_[here].vertex < 0;
      const std::int32_t vertex =
          ambiguous ? tetrahedron_vertex(here, ring[n].tetrahedron) : nodes_[here].vertex;
      if (polygon_.empty() || polygon_.back() != vertex) polygon_.push_back(vertex);
      simple &= !ambiguous;
      if (ambiguous || nodes_[beyond].vertex < 0) {
        polygon_.push_back(side_vertex(start, ring[n], here, beyond));
      }
    }
    if (polygon_.size() > 1 && polygon_.front() == polygon_.back()) polygon_.pop_back();
    if (polygon_.size() < 3) return;
    const std::int64_t edge = static_cast<std::int64_t>(start) * 8 + d;
    const auto add_face = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
      result_.mesh.faces.push_back({a, b, c});
      result_.sides.push_back(sides);
      result_.edge.push_back(edge);
    };
    const Vec3 low = sample_position(start), direction = step_vector(d);
    if (simple && polygon_.size() == 4) {
      const auto& p = polygon_;
      const double first = (local_[p[0]] - local_[p[2]]).squaredNorm();
      const double second = (local_[p[1]] - local_[p[3]]).squaredNorm();
      const int shorter = first <= second ? 0 : 1;
      for (const int k : {shorter, 1 - shorter}) {
        const std::array<std::int32_t, 4> q = {p[k], p[k + 1], p[k + 2], p[(k + 3) % 4]};
        if (!two_triangles_fit(low, low + direction, q)) continue;
        add_face(q[0], q[1], q[2]);
        add_face(q[0], q[2], q[3]);
        return;
      }
    }
    double along = 0;
    for (const std::int32_t v : polygon_) along += (local_[v] - low).dot(direction);
    along /= static_cast<double>(polygon_.size()) * direction.squaredNorm();
    along = std::clamp(along, edge_margin, 1 - edge_margin);
    const std::int32_t middle = add_vertex(key(start, 8 + d), low + along * direction);
    for (std::size_t n = 0; n < polygon_.size(); ++n) {
      add_face(middle, polygon_[n], polygon_[(n + 1) % polygon_.size()]);
    }
  }

  /// Whether the triangles (0, 1, 2) and (0, 2, 3) stay in the tetrahedra between the lattice edge
  /// and the neighbouring vertices: the edge pierces one of them, and their common diagonal goes
  /// through the triangle between the edge and the corner of the other one.
  bool two_triangles_fit(const Vec3& low, const Vec3& high,
                         const std::array<std::int32_t, 4>& q) const {
    const Vec3 &a = local_[q[0]], &c = local_[q[2]];
    for (const int k : {1, 3}) {
      const Vec3 &pierced = local_[q[k]], &passed = local_[q[4 - k]];
      if (crosses(low, high, a, pierced, c) && crosses(a, c, low, high, passed)) return true;
    }
    return false;
  }

  /// Whether the segment from p to q crosses the triangle (a, b, c), with a margin.
  static bool crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto side = [](const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& w) {
      const double value = (y - x).cross(z - x).dot(w - x);
      return value > flat ? 1 : value < -flat ? -1 : 0;
    };
    if (side(a, b, c, p) * side(a, b, c, q) >= 0) return false;
    const int s = side(p, q, a, b);
    return s != 0 && s == side(p, q, b, c) && s == side(p, q, c, a);
  }

  const VoxelGrid<std::int32_t>& grid_;
  const InterfaceOptions& options_;
  const KuhnTables& tables_;
  std::array<std::size_t, 8> step_{};
  std::vector<std::int32_t> cell_node_;  ///< node, or uniform
  std::vector<Node> nodes_;              ///< by ascending cell; the first vertices are theirs
  std::vector<CellPoint> points_;        ///< parallel to nodes_
  std::vector<Vec3> local_;              ///< positions of the vertices, in cells
  std::unordered_map<std::uint64_t, std::int32_t> shared_;
  std::vector<std::int32_t> polygon_;
  InterfaceMesh result_;
};

}  // namespace

InterfaceMesh extract_interfaces(const LabelLattice& lattice, const InterfaceOptions& options) {
  return Extraction(lattice, options).run();
}

}  // namespace fracbench::partition
