#include "scenarios/rigid/colliders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "geometry/measures.h"
#include "scenarios/rigid/convex_hull.h"

namespace fracbench {

namespace {

constexpr std::size_t kTrianglesToChooseBy = 200;
// Collisions take as long as a part has vertices. Of a ball of radius r, so many leave out at most
// 0.06 r.
constexpr std::size_t kMaxVertices = 48;

using Triangle = std::array<Vec3, 3>;
using Triangles = std::vector<Triangle>;

struct Plane {
  Vec3 normal;
  double offset = 0;
};

/// Part of the solid: the triangles of its surface there. What the cuts opened is not closed: the
/// hull is the same, since the cut's outline is among the triangles.
struct Part {
  Triangles surface;
  ConvexHull hull;
  double concavity = 0;  ///< how deep the surface goes below the hull, m
  Vec3 deepest = Vec3::Zero();
  Vec3 deepest_normal = Vec3::Zero();
};

ConvexHull hull_of(const Triangles& surface) {
  std::vector<Vec3> points;
  points.reserve(3 * surface.size());
  for (const Triangle& triangle : surface)
    points.insert(points.end(), triangle.begin(), triangle.end());
  return convex_hull(points);
}

/// The triangle's part where normal . x >= offset (side = 1) or <= offset (side = -1).
void clip(const Triangle& triangle, const Plane& plane, double side, Triangles& kept) {
  std::array<double, 3> height{};
  for (int k = 0; k < 3; ++k) height[k] = side * (plane.normal.dot(triangle[k]) - plane.offset);
  if (std::ranges::min(height) >= 0) {
    kept.push_back(triangle);
    return;
  }
  if (std::ranges::max(height) <= 0) return;
  std::array<Vec3, 4> polygon;
  std::size_t corners = 0;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (height[k] >= 0) polygon[corners++] = triangle[k];
    if ((height[k] > 0 && height[next] < 0) || (height[k] < 0 && height[next] > 0)) {
      const double t = height[k] / (height[k] - height[next]);
      polygon[corners++] = triangle[k] + t * (triangle[next] - triangle[k]);
    }
  }
  for (std::size_t k = 1; k + 1 < corners; ++k)
    kept.push_back({polygon[0], polygon[k], polygon[k + 1]});
}

void find_concavity(Part& part) {
  part.concavity = 0;
  for (const Triangle& triangle : part.surface) {
    const Vec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3;
    for (const Vec3& point : {triangle[0], triangle[1], triangle[2], middle}) {
      double depth = std::numeric_limits<double>::infinity();
      for (const ConvexHull::Plane& plane : part.hull.planes) {
        depth = std::min(depth, plane.offset - plane.normal.dot(point));
        if (depth <= part.concavity) break;
      }
      if (depth <= part.concavity) continue;
      part.concavity = depth;
      part.deepest = point;
      part.deepest_normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    }
  }
}

/// Cut through the deepest point, across an axis or along the surface there: whichever leaves the
/// smaller hulls.
std::optional<std::pair<Part, Part>> cut(const Part& part) {
  std::vector<Vec3> normals = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  if (part.deepest_normal.norm() > 0) normals.push_back(part.deepest_normal.normalized());
  // Some triangles are enough to choose the plane by.
  const std::size_t stride = 1 + part.surface.size() / kTrianglesToChooseBy;
  std::optional<Plane> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& normal : normals) {
    const Plane plane = {normal, normal.dot(part.deepest)};
    Triangles above;
    Triangles below;
    for (std::size_t t = 0; t < part.surface.size(); t += stride) {
      clip(part.surface[t], plane, 1, above);
      clip(part.surface[t], plane, -1, below);
    }
    const ConvexHull first = hull_of(above);
    const ConvexHull second = hull_of(below);
    if (first.vertices.empty() || second.vertices.empty()) continue;
    if (first.volume + second.volume >= least) continue;
    least = first.volume + second.volume;
    best = plane;
  }
  if (!best) return std::nullopt;
  std::pair<Part, Part> halves;
  for (const Triangle& triangle : part.surface) {
    clip(triangle, *best, 1, halves.first.surface);
    clip(triangle, *best, -1, halves.second.surface);
  }
  halves.first.hull = hull_of(halves.first.surface);
  halves.second.hull = hull_of(halves.second.surface);
  if (halves.first.hull.vertices.empty() || halves.second.hull.vertices.empty())
    return std::nullopt;
  return halves;
}

std::vector<Part> decompose(const TriangleMesh& mesh, const ColliderOptions& options) {
  std::vector<Part> parts(1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    parts[0].surface.push_back({mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)});
  }
  parts[0].hull = convex_hull(mesh.vertices);
  find_concavity(parts[0]);
  while (static_cast<int>(parts.size()) < options.max_parts) {
    const auto worst = std::ranges::max_element(parts, {}, &Part::concavity);
    if (worst->concavity <= options.tolerance) break;
    std::optional<std::pair<Part, Part>> halves = cut(*worst);
    if (!halves) {
      worst->concavity = 0;  // no cut helps: leave it as it is
      continue;
    }
    find_concavity(halves->first);
    find_concavity(halves->second);
    *worst = std::move(halves->first);
    parts.push_back(std::move(halves->second));
  }
  return parts;
}

/// Of many vertices those that are farthest in some evenly spread directions (Fibonacci lattice).
std::vector<Vec3> thinned(const std::vector<Vec3>& vertices) {
  if (vertices.size() <= kMaxVertices) return vertices;
  std::vector<bool> keep(vertices.size(), false);
  for (std::size_t k = 0; k < kMaxVertices; ++k) {
    const double z = 1 - (2 * static_cast<double>(k) + 1) / kMaxVertices;
    const double angle = static_cast<double>(k) * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    const Vec3 direction(r * std::cos(angle), r * std::sin(angle), z);
    std::size_t farthest = 0;
    for (std::size_t v = 1; v < vertices.size(); ++v) {
      if (direction.dot(vertices[v]) > direction.dot(vertices[farthest])) farthest = v;
    }
    keep[farthest] = true;
  }
  std::vector<Vec3> kept;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (keep[v]) kept.push_back(vertices[v]);
  }
  return kept;
}

std::vector<Vec3> corners(const Vec3& center, const Vec3& half) {
  std::vector<Vec3> points;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    points.push_back(center + sign.cwiseProduct(half));
  }
  return points;
}

/// A solid too thin to have a hull collides as a box a tenth as large as its own.
Collider::Part tiny_box(const TriangleMesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  return {.vertices = corners(box.center(), ((box.high - box.low) / 20).cwiseMax(1e-4))};
}

}  // namespace

Collider box_collider(const TriangleMesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  return {.parts = {{.vertices = corners(box.center(), (box.high - box.low) / 2)}}};
}

Collider make_collider(const TriangleMesh& mesh, const ColliderOptions& options) {
  Collider collider;
  for (const Part& part : decompose(mesh, options)) {
    const ConvexHull hull = convex_hull(part.hull.vertices, options.gap);
    if (hull.vertices.empty()) continue;
    collider.parts.push_back({.vertices = thinned(hull.vertices), .margin = hull.inset / 2});
  }
  if (collider.parts.empty()) collider.parts.push_back(tiny_box(mesh));
  return collider;
}

}  // namespace fracbench
