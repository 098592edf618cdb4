#include "geometry/overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "core/parallel.h"
#include "geometry/measures.h"
#include "geometry/surface_distance.h"
#include "geometry/triangle_tree.h"

namespace fracbench {
namespace {

// A solid prepared for questions about points and edges of others.
class Solid {
 public:
  Solid(const TriangleMesh& solid, double tolerance)
      : mesh(solid),
        box(bounding_box(solid)),
        surface_(solid),
        tree_(solid),
        tolerance_(tolerance) {
    std::set<std::pair<std::int32_t, std::int32_t>> unique;
    for (const Face& face : mesh.faces) {
      for (int k = 0; k < 3; ++k) unique.insert(std::minmax(face[k], face[(k + 1) % 3]));
    }
    edges.assign(unique.begin(), unique.end());
    used.assign(mesh.vertices.size(), 0);
    for (const Face& face : mesh.faces) {
      for (const std::int32_t v : face) used[v] = 1;
    }
    interior = find_interior();
  }

  // Positive inside, but for points nearer to the surface than the tolerance, where the sign does
  // not matter. `near` is a triangle that is likely to be near, and becomes the nearest.
  double depth(const Vec3& point, std::int32_t& near) const {
    const TriangleTree::Group<1> query{{point}, {near}};
    const TriangleTree::Nearest found = tree_.nearest(query)[0];
    near = found.triangle;
    const double distance = std::sqrt(found.squared_distance);
    return distance <= tolerance_ || surface_.inside(point) ? distance : -distance;
  }

  // An upper bound of the depth that costs nothing: points out of the box are not inside.
  double depth_bound(const Vec3& point) const {
    const Vec3 outside = (box.low - point).cwiseMax(point - box.high);
    return outside.maxCoeff() > 0 ? -outside.maxCoeff() : std::numeric_limits<double>::infinity();
  }

  // Where the edge from p to q may cross the surface, as parameters in ascending order, 0 and 1
  // included. All true crossings are among them, up to rounding; others do no harm.
  std::vector<double> crossings(const Vec3& p, const Vec3& q) const {
    std::vector<double> result{0, 1};
    constexpr float slack = 1e-6f;  // in the frame of the boxes, beyond float rounding
    const Eigen::Vector3f a = tree_.to_box_frame(p);
    const Eigen::Vector3f b = tree_.to_box_frame(q);
    const Eigen::Vector3f low = a.cwiseMin(b).array() - slack;
    const Eigen::Vector3f high = a.cwiseMax(b).array() + slack;
    const auto passes = [&](const TriangleTree::Node& node) {
      unsigned mask = 0;
      for (int k = 0; k < 4; ++k) {
        bool meets = true;
        for (int axis = 0; axis < 3; ++axis) {
          meets = meets && node.low[axis][k] <= high[axis] && node.high[axis][k] >= low[axis];
        }
        mask |= static_cast<unsigned>(meets) << k;
      }
      return mask;
    };
    tree_.visit(passes, [&](std::int32_t index) {
      if (const auto t = crossing(tree_.triangles()[index], p, q)) result.push_back(*t);
    });
    std::ranges::sort(result);
    return result;
  }

  const TriangleMesh& mesh;
  BoundingBox box;
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  std::vector<std::uint8_t> used;  // of the vertices: whether a face has it
  std::optional<Vec3> interior;    // a point well inside

 private:
  std::optional<double> crossing(const TreeTriangle& triangle, const Vec3& p, const Vec3& q) const {
    const Vec3 normal = triangle.ab.cross(triangle.ac);
    const double side_p = (p - triangle.a).dot(normal);
    const double side_q = (q - triangle.a).dot(normal);
    if (side_p * side_q > 0 || side_p == side_q) return std::nullopt;
    // An edge in the plane of the triangle leaves it where it crosses one of its neighbours.
    const double flat = tolerance_ * normal.norm();
    if (std::abs(side_p) <= flat && std::abs(side_q) <= flat) return std::nullopt;
    const double t = side_p / (side_p - side_q);
    // Barycentric coordinates of the crossing, with slack.
    const Vec3 at = p + t * (q - p) - triangle.a;
    const double scale = normal.squaredNorm();
    const double v = at.cross(triangle.ac).dot(normal) / scale;
    const double w = triangle.ab.cross(at).dot(normal) / scale;
    constexpr double slack = 1e-6;
    if (v < -slack || w < -slack || v + w > 1 + slack) return std::nullopt;
    return t;
  }

  // The middle of the way inwards from the middle of a large face.
  std::optional<Vec3> find_interior() const {
    std::size_t largest = 0;
    double size = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const double here = area_vector2(mesh, f).squaredNorm();
      if (here > size) {
        size = here;
        largest = f;
      }
    }
    if (size == 0) return std::nullopt;
    const Vec3 normal = area_vector2(mesh, largest).normalized();
    const Vec3 start =
        (mesh.corner(largest, 0) + mesh.corner(largest, 1) + mesh.corner(largest, 2)) / 3 -
        tolerance_ * normal;
    const SurfaceDistance::Hit hit = surface_.first_hit(start, -normal);
    if (hit.face < 0) return std::nullopt;
    return start - hit.t / 2 * normal;
  }

  SurfaceDistance surface_;
  TriangleTree tree_;
  double tolerance_;  // m
};

bool boxes_overlap(const BoundingBox& a, const BoundingBox& b, double tolerance) {
  return ((a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low)).array() > tolerance).all();
}

struct Place {
  Vec3 point;
  double depth;
};

// A point of `a` that is deep inside `b`. The depth changes no faster than the place, which spares
// most questions.
std::optional<Place> deep_point(const Solid& a, const Solid& b, double tolerance) {
  std::int32_t near = -1;
  const auto test = [&](const Vec3& point) -> std::optional<Place> {
    if (b.depth_bound(point) <= tolerance) return std::nullopt;
    const double here = b.depth(point, near);
    if (here <= tolerance) return std::nullopt;
    return Place{point, here};
  };
  if (a.interior) {
    if (const auto found = test(*a.interior)) return found;
  }
  const std::vector<Vec3>& vertices = a.mesh.vertices;
  std::vector<double> depth(vertices.size(), -std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!a.used[v]) continue;
    depth[v] = b.depth_bound(vertices[v]);
    if (depth[v] <= tolerance) continue;
    depth[v] = b.depth(vertices[v], near);
    if (depth[v] > tolerance) return Place{vertices[v], depth[v]};
  }
  for (std::size_t f = 0; f < a.mesh.faces.size(); ++f) {
    const Vec3 middle = (a.mesh.corner(f, 0) + a.mesh.corner(f, 1) + a.mesh.corner(f, 2)) / 3;
    double bound = std::numeric_limits<double>::infinity();
    for (const std::int32_t v : a.mesh.faces[f]) {
      bound = std::min(bound, depth[v] + (middle - vertices[v]).norm());
    }
    if (bound <= tolerance) continue;
    if (const auto found = test(middle)) return found;
  }
  for (const auto& [u, v] : a.edges) {
    const Vec3& p = vertices[u];
    const Vec3& q = vertices[v];
    if ((depth[u] + depth[v] + (q - p).norm()) / 2 <= tolerance) continue;
    const std::vector<double> parts = b.crossings(p, q);
    for (std::size_t k = 1; k < parts.size(); ++k) {
      if ((parts[k] - parts[k - 1]) * (q - p).norm() <= 2 * tolerance) continue;
      if (const auto found = test(p + (parts[k - 1] + parts[k]) / 2 * (q - p))) return found;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<Overlap> find_overlaps(
    std::span<const std::reference_wrapper<const TriangleMesh>> meshes,
    const OverlapOptions& options) {
  std::vector<std::optional<Solid>> solids(meshes.size());
  parallel_for(meshes.size(), options.threads,
               [&](std::size_t i) { solids[i].emplace(meshes[i].get(), options.tolerance); });

  std::vector<Overlap> pairs;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (std::size_t j = i + 1; j < solids.size(); ++j) {
      if (!boxes_overlap(solids[i]->box, solids[j]->box, options.tolerance)) continue;
      pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), Vec3::Zero()});
    }
  }
  parallel_for(pairs.size(), options.threads, [&](std::size_t k) {
    const Solid& a = *solids[pairs[k].first];
    const Solid& b = *solids[pairs[k].second];
    auto found = deep_point(a, b, options.tolerance);
    if (!found) found = deep_point(b, a, options.tolerance);
    if (!found) return;
    pairs[k].place = found->point;
    pairs[k].depth = found->depth;
  });
  std::erase_if(pairs, [](const Overlap& pair) { return pair.depth == 0; });
  return pairs;
}

}  // namespace fracbench
