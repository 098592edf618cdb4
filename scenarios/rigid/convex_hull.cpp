#include "scenarios/rigid/convex_hull.h"

#include <LinearMath/btConvexHullComputer.h>

namespace fracbench {

namespace {

constexpr double kLargestInsetShare = 0.25;

Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

ConvexHull convex_hull(std::span<const Vec3> points, double inset) {
  ConvexHull hull;
  if (points.size() < 4) return hull;
  btConvexHullComputer computer;
  hull.inset = computer.compute(points[0].data(), sizeof(Vec3), static_cast<int>(points.size()),
                                inset, kLargestInsetShare);
  if (hull.inset < 0 || computer.vertices.size() < 4) return ConvexHull{};
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

}  // namespace fracbench
