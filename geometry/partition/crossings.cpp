#include "geometry/partition/crossings.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <tuple>

#include "core/parallel.h"
#include "geometry/exact_predicates.h"
#include "geometry/triangle_tree.h"

namespace fracbench::partition {
namespace {

__extension__ typedef __float128 Quad;

auto order(const Crossing& c) { return std::tuple(!c.body_edge, c.a, c.b, c.face); }

/// The faces of the body in each cell that holds interfaces.
struct FacesInCells {
  std::vector<std::int32_t> rank;   ///< per cell; -1: no interface there
  std::vector<std::int32_t> begin;  ///< per rank, into faces
  std::vector<std::int32_t> faces;

  FacesInCells(const TriangleMesh& body, const InterfaceMesh& interfaces,
               const VoxelGrid<std::int32_t>& grid)
      : rank(grid.values.size(), -1) {
    std::int32_t ranks = 0;
    std::int64_t last = -1;
    for (const std::int64_t edge : interfaces.edge) {
      if (edge == last) continue;
      last = edge;
      for_each_cell_of_edge(grid, edge, [&](std::size_t cell) {
        if (rank[cell] < 0) rank[cell] = ranks++;
      });
    }
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
      for_each_touched_cell(grid, body, f, [&](std::size_t cell) {
        if (rank[cell] >= 0) pairs.emplace_back(rank[cell], static_cast<std::int32_t>(f));
      });
    }
    begin.assign(static_cast<std::size_t>(ranks) + 1, 0);
    for (const auto& [r, f] : pairs) ++begin[r + 1];
    for (std::int32_t r = 0; r < ranks; ++r) begin[r + 1] += begin[r];
    faces.resize(pairs.size());
    std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
    for (const auto& [r, f] : pairs) faces[next[r]++] = f;
  }
};

/// A segment whose ends are not numbered yet.
struct Found {
  std::int32_t body_face, interface_face;
  Crossing from, to;
};

int sign_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int sign = side_of_plane(a, b, c, d);
  if (sign == 0) throw NotGeneric("four points of the body and the interfaces are on a plane");
  return sign;
}

Crossing make_crossing(bool body_edge, std::int32_t p, std::int32_t q, std::int32_t face) {
  Crossing c;
  c.body_edge = body_edge;
  c.a = std::min(p, q);
  c.b = std::max(p, q);
  c.face = face;
  return c;
}

/// Adds what faces s of the body and i of the interfaces have in common.
void intersect(const TriangleMesh& body, const TriangleMesh& interfaces, std::int32_t s,
               std::int32_t i, std::vector<Found>& found) {
  std::array<const Vec3*, 3> p, q;
  for (int k = 0; k < 3; ++k) {
    p[k] = &body.corner(s, k);
    q[k] = &interfaces.corner(i, k);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto [p_low, p_high] = std::minmax({(*p[0])[axis], (*p[1])[axis], (*p[2])[axis]});
    const auto [q_low, q_high] = std::minmax({(*q[0])[axis], (*q[1])[axis], (*q[2])[axis]});
    if (p_high < q_low || q_high < p_low) return;
  }
  std::array<int, 3> q_side, p_side;  // of the other face's plane
  for (int k = 0; k < 3; ++k) q_side[k] = sign_of(*p[0], *p[1], *p[2], *q[k]);
  if (q_side[0] == q_side[1] && q_side[1] == q_side[2]) return;
  for (int k = 0; k < 3; ++k) p_side[k] = sign_of(*q[0], *q[1], *q[2], *p[k]);
  if (p_side[0] == p_side[1] && p_side[1] == p_side[2]) return;

  std::array<std::array<int, 3>, 3> around;  // of the edge from p[m] and that from q[n]
  for (int m = 0; m < 3; ++m) {
    for (int n = 0; n < 3; ++n) {
      around[m][n] = sign_of(*p[m], *p[(m + 1) % 3], *q[n], *q[(n + 1) % 3]);
    }
  }
  Found segment{s, i, {}, {}};
  int sources = 0, targets = 0;
  const auto add = [&](bool source, const Crossing& crossing) {
    (source ? segment.from : segment.to) = crossing;
    ++(source ? sources : targets);
  };
  for (int m = 0; m < 3; ++m) {
    const int next = (m + 1) % 3;
    if (p_side[m] != p_side[next] && around[m][0] == around[m][1] && around[m][1] == around[m][2]) {
      add(p_side[m] < 0, make_crossing(true, body.faces[s][m], body.faces[s][next], i));
    }
    if (q_side[m] != q_side[next] && around[0][m] == around[1][m] && around[1][m] == around[2][m]) {
      add(q_side[m] > 0,
          make_crossing(false, interfaces.faces[i][m], interfaces.faces[i][next], s));
    }
  }
  if (sources == 0 && targets == 0) return;
  if (sources != 1 || targets != 1) throw NotGeneric("two faces meet in more than a segment");
  found.push_back(segment);
}

/// `make_near()` gives a function that finds, for an interface face, the faces of the body that may
/// meet it, ascending; one is made for each of the parallel parts.
template <typename MakeNear>
std::vector<Found> intersect_all(const TriangleMesh& body, const TriangleMesh& interfaces,
                                 const MakeNear& make_near, int threads) {
  constexpr std::size_t chunk = 4096;
  const std::size_t count = interfaces.faces.size();
  std::vector<std::vector<Found>> found((count + chunk - 1) / chunk);
  std::atomic<bool> generic = true;
  parallel_for(found.size(), threads, [&](std::size_t n) {
    auto near = make_near();
    try {
      for (std::size_t i = n * chunk; i < std::min(count, (n + 1) * chunk); ++i) {
        for (const std::int32_t s : near(i)) {
          intersect(body, interfaces, s, static_cast<std::int32_t>(i), found[n]);
        }
      }
    } catch (const NotGeneric&) {
      generic = false;
    }
  });
  if (!generic) throw NotGeneric("body and interfaces are not in general position");
  std::vector<Found> all;
  for (auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// The faces of the body in the cells around the lattice edge that an interface face crosses.
class NearLatticeEdge {
 public:
  NearLatticeEdge(const FacesInCells& cells, const InterfaceMesh& interfaces,
                  const VoxelGrid<std::int32_t>& grid)
      : cells_(cells), interfaces_(interfaces), grid_(grid) {}

  const std::vector<std::int32_t>& operator()(std::size_t i) {
    if (interfaces_.edge[i] == last_) return near_;
    last_ = interfaces_.edge[i];
    near_.clear();
    int lists = 0;
    for_each_cell_of_edge(grid_, last_, [&](std::size_t cell) {
      const std::int32_t r = cells_.rank[cell];
      if (cells_.begin[r] == cells_.begin[r + 1]) return;
      near_.insert(near_.end(), cells_.faces.begin() + cells_.begin[r],
                   cells_.faces.begin() + cells_.begin[r + 1]);
      ++lists;
    });
    if (lists > 1) {
      std::sort(near_.begin(), near_.end());
      near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
    }
    return near_;
  }

 private:
  const FacesInCells& cells_;
  const InterfaceMesh& interfaces_;
  const VoxelGrid<std::int32_t>& grid_;
  std::vector<std::int32_t> near_;
  std::int64_t last_ = -1;
};

/// The faces of the body whose boxes meet that of an interface face.
class NearInTree {
 public:
  NearInTree(const TriangleTree& tree, const TriangleMesh& interfaces)
      : tree_(tree), interfaces_(interfaces) {}

  const std::vector<std::int32_t>& operator()(std::size_t i) {
    near_.clear();
    const Vec3 &a = interfaces_.corner(i, 0), &b = interfaces_.corner(i, 1),
               &c = interfaces_.corner(i, 2);
    const Eigen::Vector3f low = tree_.to_box_frame(a.cwiseMin(b).cwiseMin(c)).array() - slack;
    const Eigen::Vector3f high = tree_.to_box_frame(a.cwiseMax(b).cwiseMax(c)).array() + slack;
    tree_.visit(
        [&](const TriangleTree::Node& node) {
          unsigned mask = 0;
          for (int k = 0; k < 4; ++k) {
            bool meets = true;
            for (int axis = 0; axis < 3; ++axis) {
              meets &= node.low[axis][k] <= high[axis] && node.high[axis][k] >= low[axis];
            }
            mask |= static_cast<unsigned>(meets) << k;
          }
          return mask;
        },
        [&](std::int32_t t) { near_.push_back(tree_.triangles()[t].face); });
    std::sort(near_.begin(), near_.end());
    return near_;
  }

 private:
  static constexpr float slack = 1e-5f;  // covers the rounding to single precision

  const TriangleTree& tree_;
  const TriangleMesh& interfaces_;
  std::vector<std::int32_t> near_;
};

using Quad3 = std::array<Quad, 3>;

Quad3 difference(const Vec3& a, const Vec3& b) {
  return {Quad(a.x()) - Quad(b.x()), Quad(a.y()) - Quad(b.y()), Quad(a.z()) - Quad(b.z())};
}

Quad dot(const Quad3& a, const Quad3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Sets the position, and returns how far along the edge it is.
Quad place(Crossing& crossing, const TriangleMesh& edges, const TriangleMesh& faces) {
  const Vec3 &a = edges.vertices[crossing.a], &b = edges.vertices[crossing.b];
  const Vec3& origin = faces.corner(crossing.face, 0);
  const Quad3 u = difference(faces.corner(crossing.face, 1), origin);
  const Quad3 v = difference(faces.corner(crossing.face, 2), origin);
  const Quad3 normal = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                        u[0] * v[1] - u[1] * v[0]};
  const Quad at_a = dot(normal, difference(a, origin)), at_b = dot(normal, difference(b, origin));
  const Quad t = at_a / (at_a - at_b);
  for (int axis = 0; axis < 3; ++axis) {
    crossing.position[axis] =
        static_cast<double>(Quad(a[axis]) + t * (Quad(b[axis]) - Quad(a[axis])));
  }
  return t;
}

}  // namespace

std::pair<std::int32_t, std::int32_t> Crossings::on_edge(bool body_edge, std::int32_t a,
                                                         std::int32_t b) const {
  const auto key = std::tuple(!body_edge, std::min(a, b), std::max(a, b));
  const auto edge = [](const Crossing& c) { return std::tuple(!c.body_edge, c.a, c.b); };
  const auto low = std::lower_bound(crossings.begin(), crossings.end(), key,
                                    [&](const Crossing& c, const auto& k) { return edge(c) < k; });
  auto high = low;
  while (high != crossings.end() && edge(*high) == key) ++high;
  return {static_cast<std::int32_t>(low - crossings.begin()),
          static_cast<std::int32_t>(high - crossings.begin())};
}

namespace {

Crossings number_crossings(const TriangleMesh& body, const TriangleMesh& interfaces,
                           std::vector<Found> found, int threads) {
  std::sort(found.begin(), found.end(), [](const Found& l, const Found& r) {
    return std::tie(l.body_face, l.interface_face) < std::tie(r.body_face, r.interface_face);
  });
  std::vector<Crossing> unique;
  unique.reserve(2 * found.size());
  for (const Found& f : found) {
    unique.push_back(f.from);
    unique.push_back(f.to);
  }
  const auto before = [](const Crossing& l, const Crossing& r) { return order(l) < order(r); };
  std::sort(unique.begin(), unique.end(), before);
  unique.erase(
      std::unique(unique.begin(), unique.end(),
                  [](const Crossing& l, const Crossing& r) { return order(l) == order(r); }),
      unique.end());

  std::vector<Quad> along(unique.size());
  parallel_for(
      unique.size(), threads,
      [&](std::size_t n) {
        along[n] = unique[n].body_edge ? place(unique[n], body, interfaces)
                                       : place(unique[n], interfaces, body);
      },
      256);

  // Numbers by key so far; in the result those of one edge follow its direction.
  std::vector<std::int32_t> at(unique.size());
  for (std::size_t n = 0; n < at.size(); ++n) at[n] = static_cast<std::int32_t>(n);
  std::sort(at.begin(), at.end(), [&](std::int32_t l, std::int32_t r) {
    const Crossing &cl = unique[l], &cr = unique[r];
    const auto key_l = std::tuple(!cl.body_edge, cl.a, cl.b);
    const auto key_r = std::tuple(!cr.body_edge, cr.a, cr.b);
    if (key_l != key_r) return key_l < key_r;
    return along[l] != along[r] ? along[l] < along[r] : l < r;
  });
  Crossings result;
  std::vector<std::int32_t> number(unique.size());
  result.crossings.reserve(unique.size());
  for (std::size_t n = 0; n < at.size(); ++n) {
    number[at[n]] = static_cast<std::int32_t>(n);
    result.crossings.push_back(unique[at[n]]);
  }
  const auto number_of = [&](const Crossing& c) {
    return number[std::lower_bound(unique.begin(), unique.end(), c, before) - unique.begin()];
  };
  result.segments.resize(found.size());
  parallel_for(
      found.size(), threads,
      [&](std::size_t n) {
        const Found& f = found[n];
        result.segments[n] = {f.body_face, f.interface_face, number_of(f.from), number_of(f.to)};
      },
      256);
  return result;
}

}  // namespace

Crossings find_crossings(const TriangleMesh& body, const InterfaceMesh& interfaces,
                         const VoxelGrid<std::int32_t>& grid, int threads) {
  const FacesInCells cells(body, interfaces, grid);
  const auto make_near = [&] { return NearLatticeEdge(cells, interfaces, grid); };
  return number_crossings(body, interfaces.mesh,
                          intersect_all(body, interfaces.mesh, make_near, threads), threads);
}

Crossings find_crossings(const TriangleMesh& body, const TriangleMesh& interfaces, int threads) {
  const TriangleTree tree(body);
  const auto make_near = [&] { return NearInTree(tree, interfaces); };
  return number_crossings(body, interfaces, intersect_all(body, interfaces, make_near, threads),
                          threads);
}

}  // namespace fracbench::partition
