#include "scenarios/rigid/convex_hull.h"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <limits>

namespace fracbench {

namespace {

constexpr double kLargestInsetShare = 0.25;

Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// The hull of the points as it is.
ConvexHull plain_hull(std::span<const Vec3> points) {
  ConvexHull hull;
  if (points.size() < 4) return hull;
  btConvexHullComputer computer;
  computer.compute(points[0].data(), sizeof(Vec3), static_cast<int>(points.size()), 0, 0);
  if (computer.vertices.size() < 4) return ConvexHull{};
  for (int i = 0; i < computer.vertices.size(); ++i) {
    hull.vertices.push_back(from_bullet(computer.vertices[i]));
  }
  Vec3 middle = Vec3::Zero();
  for (const Vec3& vertex : hull.vertices) middle += vertex;
  middle /= static_cast<double>(hull.vertices.size());
  for (int f = 0; f < computer.faces.size(); ++f) {
    const auto* first = &computer.edges[computer.faces[f]];
    const Vec3& corner = hull.vertices[first->getSourceVertex()];
    Vec3 area = Vec3::Zero();
    for (const auto* edge = first->getNextEdgeOfFace(); edge != first;
         edge = edge->getNextEdgeOfFace()) {
      area += (hull.vertices[edge->getSourceVertex()] - corner)
                  .cross(hull.vertices[edge->getTargetVertex()] - corner);
    }
    const double doubled = area.norm();
    if (!(doubled > 0)) continue;
    Vec3 normal = area / doubled;
    if (normal.dot(corner - middle) < 0) normal = -normal;
    hull.planes.push_back({.normal = normal, .offset = normal.dot(corner)});
    hull.volume += doubled * normal.dot(corner - middle) / 6;
  }
  if (!(hull.volume > 0)) return ConvexHull{};
  return hull;
}

/// A point inside: the mean of the vertices.
Vec3 center_of(const ConvexHull& hull) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& vertex : hull.vertices) middle += vertex;
  return middle / static_cast<double>(hull.vertices.size());
}

}  // namespace

ConvexHull convex_hull(std::span<const Vec3> points, double inset) {
  ConvexHull hull = plain_hull(points);
  if (hull.vertices.empty() || !(inset > 0)) return hull;
  // Bullet's own way of shrinking a hull may take all memory where faces are nearly parallel. Here
  // by duality: the planes n . (x - c) <= d become the points n / d, the planes of whose hull are
  // the vertices of the shrunk one.
  const Vec3 center = center_of(hull);
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& plane : hull.planes) {
    nearest = std::min(nearest, plane.offset - plane.normal.dot(center));
  }
  if (!(nearest > 0)) return hull;
  inset = std::min(inset, kLargestInsetShare * nearest);
  std::vector<Vec3> dual;
  for (const auto& plane : hull.planes) {
    dual.push_back(plane.normal / (plane.offset - plane.normal.dot(center) - inset));
  }
  std::vector<Vec3> corners;
  for (const auto& plane : plain_hull(dual).planes) {
    if (plane.offset > 0) corners.emplace_back(center + plane.normal / plane.offset);
  }
  ConvexHull shrunk = plain_hull(corners);
  if (shrunk.vertices.empty()) return hull;
  shrunk.inset = inset;
  return shrunk;
}

}  // namespace fracbench
