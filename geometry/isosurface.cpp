#include "geometry/isosurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

// Marching cubes by tracing instead of by table. In every cell, the crossings on its edges are
// joined over its faces, where the sign of the bilinear saddle decides an ambiguous face (Nielson
// and Hamann, "The asymptotic decider", 1991): both cells at a face decide alike. So the segments
// close to loops in each cell, each segment belongs to two cells, and around every crossing the
// four cells of its edge make one fan: the surface is closed and manifold whatever the field.
// Loops become triangles without a diagonal in a face of the cell, which the neighbour could have
// too; where there is no such triangulation, a vertex is added in the loop's middle.
// Loops of one cell stay apart: a trilinear tunnel through a single cell is closed.

namespace fracbench {
namespace {

// Crossings stay this far from the samples, as a share of the spacing, so that vertices of
// neighbouring edges never coincide.
constexpr double clearance = 1e-3;

using Corner = std::array<int, 3>;

/// Edge 4 a + b runs along axis a; the two bits of b are its places on the next two axes.
struct Edge {
  int axis;
  Corner low;  ///< its corner at the smaller coordinate
};

constexpr std::array<Edge, 12> make_edges() {
  std::array<Edge, 12> edges{};
  for (int e = 0; e < 12; ++e) {
    edges[e].axis = e / 4;
    edges[e].low[(e / 4 + 1) % 3] = e & 1;
    edges[e].low[(e / 4 + 2) % 3] = e >> 1 & 1;
  }
  return edges;
}
constexpr std::array<Edge, 12> cell_edges = make_edges();

constexpr int corner_bit(const Corner& c) { return c[0] + 2 * c[1] + 4 * c[2]; }

constexpr int edge_between(int p, int q) {
  for (int e = 0; e < 12; ++e) {
    const int low = corner_bit(cell_edges[e].low), high = low + (1 << cell_edges[e].axis);
    if ((p == low && q == high) || (p == high && q == low)) return e;
  }
  return -1;
}

/// The corners of face 2 axis + side, counter-clockwise seen from outside the cell, and the edge
/// from each to the next.
struct CellFace {
  std::array<int, 4> corners;
  std::array<int, 4> edges;
};

constexpr std::array<CellFace, 6> make_faces() {
  std::array<CellFace, 6> faces{};
  for (int f = 0; f < 6; ++f) {
    const int axis = f / 2, side = f % 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int k = 0; k < 4; ++k) {
      const int turn = side == 1 ? k : 3 - k;
      Corner c{};
      c[axis] = side;
      c[u] = turn == 1 || turn == 2;
      c[v] = turn >= 2;
      faces[f].corners[k] = corner_bit(c);
    }
    for (int k = 0; k < 4; ++k) {
      faces[f].edges[k] = edge_between(faces[f].corners[k], faces[f].corners[(k + 1) % 4]);
    }
  }
  return faces;
}
constexpr std::array<CellFace, 6> cell_faces = make_faces();

constexpr bool share_face(int a, int b) {
  for (const CellFace& face : cell_faces) {
    const auto has = [&](int e) {
      return face.edges[0] == e || face.edges[1] == e || face.edges[2] == e || face.edges[3] == e;
    };
    if (has(a) && has(b)) return true;
  }
  return false;
}

/// For each edge with a crossing, the edge of the next crossing around its loop; -1 elsewhere.
/// `values` are relative to the level, at the corners.
std::array<int, 12> join_crossings(const std::array<double, 8>& values) {
  std::array<int, 12> next;
  next.fill(-1);
  for (const CellFace& face : cell_faces) {
    std::array<bool, 4> inside;
    for (int k = 0; k < 4; ++k) inside[k] = values[face.corners[k]] > 0;
    const bool ambiguous =
        inside[0] == inside[2] && inside[1] == inside[3] && inside[0] != inside[1];
    // The two inside corners of an ambiguous face are joined where the saddle is inside.
    bool joined = false;
    if (ambiguous) {
      const double even = values[face.corners[0]] * values[face.corners[2]];
      const double odd = values[face.corners[1]] * values[face.corners[3]];
      joined = inside[0] ? even > odd : odd > even;
    }
    for (int k = 0; k < 4; ++k) {
      // From where the border of the face goes inside to where it leaves.
      if (inside[k] || !inside[(k + 1) % 4]) continue;
      int leave = (k + 1) % 4;
      while (inside[(leave + 1) % 4]) leave = (leave + 1) % 4;
      if (joined) leave = (k + 3) % 4;
      next[face.edges[k]] = face.edges[leave];
    }
  }
  return next;
}

class Surface {
 public:
  Surface(const VoxelGrid<float>& field, float level) : field_(field), level_(level) {
    for (int a = 0; a < 3; ++a) layer_size_[a] = field.size[a] + 2;
    const std::size_t layer = static_cast<std::size_t>(layer_size_[0]) * layer_size_[1];
    for (auto& ids : flat_ids_) ids.assign(2 * layer, -1);
    upright_ids_.assign(layer, -1);
  }

  TriangleMesh march() {
    for (int k = -1; k < field_.size[2]; ++k) {
      for (int j = -1; j < field_.size[1]; ++j) {
        for (int i = -1; i < field_.size[0]; ++i) add_cell({i, j, k});
      }
      // The upper layer becomes the lower one of the next cells.
      std::swap(flat_ids_[0], flat_ids_[1]);
      std::fill(flat_ids_[1].begin(), flat_ids_[1].end(), -1);
      std::fill(upright_ids_.begin(), upright_ids_.end(), -1);
    }
    return std::move(mesh_);
  }

 private:
  bool in_grid(const Corner& at) const {
    for (int a = 0; a < 3; ++a) {
      if (at[a] < 0 || at[a] >= field_.size[a]) return false;
    }
    return true;
  }

  /// Relative to the level; below it beyond the grid.
  double value(const Corner& at) const {
    if (!in_grid(at)) return -std::numeric_limits<double>::infinity();
    return static_cast<double>(field_.at(at[0], at[1], at[2])) - static_cast<double>(level_);
  }

  void add_cell(const Corner& cell) {
    std::array<double, 8> values;
    int count_inside = 0;
    for (int c = 0; c < 8; ++c) {
      values[c] = value({cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)});
      count_inside += values[c] > 0;
    }
    if (count_inside == 0 || count_inside == 8) return;

    std::array<int, 12> next = join_crossings(values);
    for (int first = 0; first < 12; ++first) {
      Loop loop;
      for (int e = first; next[e] >= 0;) {
        loop.edges[loop.size] = e;
        loop.ids[loop.size++] = crossing(cell, e, values);
        e = std::exchange(next[e], -1);
      }
      if (loop.size > 0) add_loop(loop);
    }
  }

  struct Loop {
    int size = 0;
    std::array<int, 12> edges;
    std::array<std::int32_t, 12> ids;
  };

  std::int32_t crossing(const Corner& cell, int e, const std::array<double, 8>& values) {
    const Edge& edge = cell_edges[e];
    std::int32_t& id = id_of(cell, edge);
    if (id >= 0) return id;
    const int low = corner_bit(edge.low), high = low + (1 << edge.axis);
    double t = values[low] / (values[low] - values[high]);
    // Beyond the grid's edge the field ends at once.
    if (std::isinf(values[low])) t = 1;
    if (std::isinf(values[high])) t = 0;
    t = std::isnan(t) ? 0.5 : std::clamp(t, clearance, 1 - clearance);
    Vec3 place(cell[0] + edge.low[0], cell[1] + edge.low[1], cell[2] + edge.low[2]);
    place[edge.axis] += t;
    id = static_cast<std::int32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(field_.origin + field_.spacing * place);
    return id;
  }

  /// Where the vertex on an edge of the current layer of cells is kept.
  std::int32_t& id_of(const Corner& cell, const Edge& edge) {
    const std::size_t column =
        (cell[0] + 1 + edge.low[0]) +
        static_cast<std::size_t>(layer_size_[0]) * (cell[1] + 1 + edge.low[1]);
    if (edge.axis == 2) return upright_ids_[column];
    return flat_ids_[edge.low[2]][2 * column + edge.axis];
  }

  void add_loop(const Loop& loop) {
    if (loop.size == 3) {
      mesh_.faces.push_back({loop.ids[0], loop.ids[1], loop.ids[2]});
      return;
    }
    if (triangulate(loop)) return;
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < loop.size; ++i) middle += mesh_.vertices[loop.ids[i]] / loop.size;
    const auto id = static_cast<std::int32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(middle);
    for (int i = 0; i < loop.size; ++i) {
      mesh_.faces.push_back({loop.ids[i], loop.ids[(i + 1) % loop.size], id});
    }
  }

  /// The triangulation with the smallest sum of squared diagonals, none of them in a face of the
  /// cell; false where there is none. (Dynamic programming over intervals, Klincsek, 1980.)
  bool triangulate(const Loop& loop) {
    constexpr double none = std::numeric_limits<double>::infinity();
    std::array<std::array<double, 12>, 12> cost{};
    std::array<std::array<int, 12>, 12> apex{};
    const auto diagonal = [&](int i, int j) {
      if (j == i + 1 || (i == 0 && j == loop.size - 1)) return 0.0;
      if (share_face(loop.edges[i], loop.edges[j])) return none;

      return (mesh_.vertices[loop.ids[i]] - mesh_.vertices[loop.ids[j]]).squaredNorm();
    };
    for (int span = 2; span < loop.size; ++span) {
      for (int i = 0; i + span < loop.size; ++i) {
        const int j = i + span;
        cost[i][j] = none;
        for (int k = i + 1; k < j; ++k) {
          const double sum = cost[i][k] + cost[k][j] + diagonal(i, j);
          if (sum < cost[i][j]) {
            cost[i][j] = sum;
            apex[i][j] = k;
          }
        }
      }
    }
    if (cost[0][loop.size - 1] == none) return false;
    std::vector<std::pair<int, int>> open{{0, loop.size - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j - i < 2) continue;
      const int k = apex[i][j];
      mesh_.faces.push_back({loop.ids[i], loop.ids[k], loop.ids[j]});
      open.emplace_back(i, k);
      open.emplace_back(k, j);
    }
    return true;
  }

  const VoxelGrid<float>& field_;
  float level_;
  std::array<int, 3> layer_size_{};
  std::array<std::vector<std::int32_t>, 2> flat_ids_;  ///< of edges along x and y, lower and upper
  std::vector<std::int32_t> upright_ids_;              ///< of edges along z between them
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh isosurface(const VoxelGrid<float>& field, float level) {
  return Surface(field, level).march();
}

}  // namespace fracbench
