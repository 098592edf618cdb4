#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <span>

#include "core/parallel.h"
#include "geometry/check_mesh.h"
#include "geometry/edge_table.h"
#include "geometry/equal_vertices.h"
#include "geometry/exact_predicates.h"
#include "geometry/triangle_tree.h"

namespace fracbench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using FacePair = std::pair<std::int32_t, std::int32_t>;

Kernel::Point_3 point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

Point2 without(int axis, const Vec3& p) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int axis = 0; axis < 3; ++axis) {
    if (orientation(without(axis, a), without(axis, b), without(axis, c)) != 0) return false;
  }
  return true;
}

/// For four points of one plane: whether p and q are on the same side of the line from a to b.
bool same_side(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  for (int axis = 0; axis < 3; ++axis) {
    const int side = orientation(without(axis, a), without(axis, b), without(axis, p));
    if (side != 0) {
      return side == orientation(without(axis, a), without(axis, b), without(axis, q));
    }
  }
  return false;
}

/// A face whose corners are numbered by position, so that corners count as shared wherever they are
/// equal.
struct Corners {
  Face id;
  std::array<Vec3, 3> at;

  Kernel::Triangle_3 triangle() const { return {point(at[0]), point(at[1]), point(at[2])}; }
  Kernel::Segment_3 side_opposite(int k) const {
    return {point(at[(k + 1) % 3]), point(at[(k + 2) % 3])};
  }
};

/// Whether some corners of `other`, but for corner `skip`, are on different sides of the plane of
/// `face`, or on it.
bool plane_meets(const Corners& face, const Corners& other, int skip) {
  int seen = 2;
  for (int k = 0; k < 3; ++k) {
    if (k == skip) continue;
    const int side = side_of_plane(face.at[0], face.at[1], face.at[2], other.at[k]);
    if (side == 0 || (seen != 2 && side != seen)) return true;
    seen = side;
  }
  return false;
}

/// Whether a line through the corner that two faces share parts them, seen along an axis; then they
/// meet nowhere else. Spares nearly all exact tests among faces around one vertex, which are many
/// where a fan closes the end of a cylinder: all of its boxes overlap.
bool parted_at_corner(const Corners& f, int i, const Corners& g, int j) {
  const Vec3& v = f.at[i];
  const std::array<const Vec3*, 2> p{&f.at[(i + 1) % 3], &f.at[(i + 2) % 3]};
  const std::array<const Vec3*, 2> q{&g.at[(j + 1) % 3], &g.at[(j + 2) % 3]};
  int axis = 0;
  (*p[0] - v).cross(*p[1] - v).cwiseAbs().maxCoeff(&axis);
  const auto parts = [&](const Vec3& end, const Vec3& own,
                         const std::array<const Vec3*, 2>& other) {
    const Point2 from = without(axis, v), to = without(axis, end);
    const int side = orientation(from, to, without(axis, own));
    return side != 0 && orientation(from, to, without(axis, *other[0])) == -side &&
           orientation(from, to, without(axis, *other[1])) == -side;
  };
  return parts(*p[0], *p[1], q) || parts(*p[1], *p[0], q) || parts(*q[0], *q[1], p) ||
         parts(*q[1], *q[0], p);
}

/// Whether two faces, neither of zero area, meet outside the corners and sides they share.
bool intersect(const Corners& f, const Corners& g) {
  int shared = 0;
  std::array<bool, 3> f_shared{}, g_shared{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (f.id[i] != g.id[j]) continue;
      f_shared[i] = g_shared[j] = true;
      ++shared;
    }
  }
  const auto first = [](const std::array<bool, 3>& flags, bool value) {
    return static_cast<int>(std::find(flags.begin(), flags.end(), value) - flags.begin());
  };
  if (shared == 3) return true;
  if (shared == 2) {
    // Only a fold onto each other.
    const int k = first(f_shared, false);
    const Vec3 &a = f.at[(k + 1) % 3], &b = f.at[(k + 2) % 3], &p = f.at[k];
    const Vec3& q = g.at[first(g_shared, false)];
    return side_of_plane(a, b, p, q) == 0 && same_side(a, b, p, q);
  }
  const int i = shared == 1 ? first(f_shared, true) : -1;
  const int j = shared == 1 ? first(g_shared, true) : -1;
  if (shared == 1 && parted_at_corner(f, i, g, j)) return false;
  if (!plane_meets(f, g, j) || !plane_meets(g, f, i)) return false;
  if (shared == 0) return CGAL::do_intersect(f.triangle(), g.triangle());
  // What they have in common is convex, so that beyond the shared corner it reaches the opposite
  // side of one of them.
  return CGAL::do_intersect(f.side_opposite(i), g.triangle()) ||
         CGAL::do_intersect(g.side_opposite(j), f.triangle());
}

/// The faces around one edge, by position, where more than two meet: pairs of neighbours in the
/// order of their angles between which the inside of one solid overlaps that of another, which is
/// where two in sequence run the same way. `apex` holds the third corner of each face, `forward`
/// whether it runs from a to b.
std::vector<std::pair<std::size_t, std::size_t>> crossings_around(const Vec3& a, const Vec3& b,
                                                                  std::span<const Vec3> apex,
                                                                  std::span<const bool> forward) {
  const Vec3& zero = apex[0];
  const auto quarter = [&](const Vec3& p) {
    const int side = side_of_plane(a, b, zero, p);
    if (side != 0) return side > 0 ? 1 : 3;
    return same_side(a, b, zero, p) ? 0 : 2;
  };
  std::vector<std::size_t> order(apex.size());
  std::vector<int> quarters(apex.size());
  for (std::size_t i = 0; i < apex.size(); ++i) {
    order[i] = i;
    quarters[i] = quarter(apex[i]);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    if (quarters[i] != quarters[j]) return quarters[i] < quarters[j];
    const int side = side_of_plane(a, b, apex[i], apex[j]);
    return side != 0 ? side > 0 : i < j;
  });
  std::vector<std::pair<std::size_t, std::size_t>> result;
  for (std::size_t n = 0; n < order.size(); ++n) {
    const std::size_t i = order[n], j = order[(n + 1) % order.size()];
    if (forward[i] == forward[j]) result.emplace_back(std::min(i, j), std::max(i, j));
  }
  return result;
}

class SelfIntersections {
 public:
  explicit SelfIntersections(const TriangleMesh& mesh) : mesh_(mesh), tree_(mesh) {
    const std::vector<std::int32_t> first = first_equal_vertex(mesh.vertices);
    by_position_.reserve(mesh.faces.size());
    for (const Face& face : mesh.faces) {
      by_position_.push_back({first[face[0]], first[face[1]], first[face[2]]});
    }
    flat_.resize(mesh.faces.size());
  }

  std::vector<FacePair> find(int threads, std::size_t limit) {
    parallel_for(
        flat_.size(), threads,
        [&](std::size_t f) {
          flat_[f] = collinear(mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2));
        },
        4096);
    // In rounds of ascending faces, small ones first, so that a mesh that intersects itself
    // everywhere ends early and the pairs found are the first ones.
    constexpr std::size_t block = 64, most_blocks = 256;
    std::vector<FacePair> pairs = crossings_at_edges();
    std::size_t new_pairs = 0;
    std::size_t begin = 0;
    for (std::size_t blocks = 4; begin < flat_.size() && new_pairs < limit;
         begin += block * blocks, blocks = std::min(2 * blocks, most_blocks)) {
      std::array<std::vector<FacePair>, most_blocks> found;
      parallel_for(blocks, threads, [&](std::size_t n) {
        const std::size_t first = begin + n * block;
        for (std::size_t f = first; f < std::min(first + block, flat_.size()); ++f) {
          if (found[n].size() >= limit) break;
          search(static_cast<std::int32_t>(f), found[n]);
        }
      });
      for (const auto& some : found) {
        pairs.insert(pairs.end(), some.begin(), some.end());
        new_pairs += some.size();
      }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    if (pairs.size() > limit) pairs.resize(limit);
    return pairs;
  }

 private:
  Corners corners(std::int32_t f) const {
    return {by_position_[f], {mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2)}};
  }

  /// Adds the faces after `f` that intersect it.
  void search(std::int32_t f, std::vector<FacePair>& found) const {
    if (flat_[f]) return;
    const Corners face = corners(f);
    const auto& [a, b, c] = face.at;
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    const Eigen::Vector3f box_low = tree_.to_box_frame(low), box_high = tree_.to_box_frame(high);
    tree_.visit(
        [&](const TriangleTree::Node& node) {
          using Flags = Eigen::Array<bool, 4, 1>;
          const Flags meets = node.low[0] <= box_high[0] && node.high[0] >= box_low[0] &&
                              node.low[1] <= box_high[1] && node.high[1] >= box_low[1] &&
                              node.low[2] <= box_high[2] && node.high[2] >= box_low[2];
          unsigned mask = 0;
          for (int k = 0; k < 4; ++k) mask |= static_cast<unsigned>(meets[k]) << k;
          return mask;
        },
        [&](std::int32_t index) {
          const std::int32_t g = tree_.triangles()[index].face;
          if (g <= f || flat_[g]) return;
          if (intersect(face, corners(g))) found.emplace_back(f, g);
        });
  }

  std::vector<FacePair> crossings_at_edges() const {
    const TriangleMesh welded{mesh_.vertices, by_position_};
    std::vector<FacePair> result;
    EdgeTable(welded).for_each_edge([&](std::int32_t low, std::int32_t high, const auto& sides) {
      // Three faces, or as many in one direction as not in the other, bound no solid: a question
      // of orientation.
      if (sides.size() < 4) return;
      std::vector<Vec3> apex;
      std::array<bool, max_faces_at_edge> forward{};
      std::vector<std::int32_t> faces;
      std::size_t ahead = 0;
      for (const EdgeTable::Side& side : sides) {
        if (flat_[side.face] || faces.size() == max_faces_at_edge) continue;
        forward[faces.size()] = side.forward;
        faces.push_back(side.face);
        apex.push_back(mesh_.corner(side.face, (side.k + 2) % 3));
        ahead += side.forward;
      }
      if (faces.size() < 4 || 2 * ahead != faces.size()) return;
      const std::span<const bool> directions(forward.data(), faces.size());
      for (const auto& [i, j] :
           crossings_around(mesh_.vertices[low], mesh_.vertices[high], apex, directions)) {
        result.emplace_back(faces[i], faces[j]);
      }
    });
    return result;
  }

  static constexpr std::size_t max_faces_at_edge = 256;

  const TriangleMesh& mesh_;
  TriangleTree tree_;
  std::vector<Face> by_position_;
  std::vector<std::uint8_t> flat_;  ///< faces of zero area, which are a defect of their own
};

}  // namespace

std::vector<FacePair> self_intersections(const TriangleMesh& mesh, int threads, std::size_t limit) {
  return SelfIntersections(mesh).find(threads, limit);
}

}  // namespace fracbench
