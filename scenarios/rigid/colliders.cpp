#include "scenarios/rigid/colliders.h"

#include <algorithm>

#include "geometry/measures.h"
#include "scenarios/rigid/convex_hull.h"

namespace fracbench {

namespace {

/// A solid too thin to have a hull collides as a box a tenth as large as its own.
Collider::Part tiny_box(const TriangleMesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  const Vec3 half = ((box.high - box.low) / 20).cwiseMax(1e-4);
  Collider::Part part;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    part.vertices.push_back(box.center() + sign.cwiseProduct(half));
  }
  return part;
}

}  // namespace

Collider make_collider(const TriangleMesh& mesh, const ColliderOptions& options) {
  Collider collider;
  const ConvexHull hull = convex_hull(mesh.vertices, options.gap);
  if (!hull.vertices.empty()) {
    collider.parts.push_back({.vertices = hull.vertices, .margin = hull.inset / 2});
  }
  if (collider.parts.empty()) collider.parts.push_back(tiny_box(mesh));
  return collider;
}

}  // namespace fracbench
