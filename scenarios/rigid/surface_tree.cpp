#include "scenarios/rigid/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace fracbench {

SurfacePoint SurfaceTree::nearest(const Vec3& query) const {
  const TriangleTree::Nearest found = tree_.nearest(query);
  const TreeTriangle& triangle = tree_.triangles()[found.triangle];
  const Vec3 point = closest_point(triangle, query);
  return {.point = point, .face = triangle.face, .distance = (point - query).norm()};
}

std::vector<SurfacePoint> SurfaceTree::within(const Vec3& query, double distance) const {
  std::vector<SurfacePoint> found;
  const Eigen::Vector3f center = tree_.to_box_frame(query);
  // The boxes are in single precision: look a little farther.
  const auto reach = static_cast<float>((distance * tree_.box_scale()) * (1 + 1e-5) + 1e-6);
  const auto passes = [&](const TriangleTree::Node& node) {
    TriangleTree::Four distance2 = TriangleTree::Four::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const TriangleTree::Four apart =
          (node.low[axis] - center[axis]).max(center[axis] - node.high[axis]).max(0.0f);
      distance2 += apart * apart;
    }
    unsigned mask = 0;
    for (int k = 0; k < 4; ++k) mask |= (distance2[k] <= reach * reach ? 1u : 0u) << k;
    return mask;
  };
  tree_.visit(passes, [&](std::int32_t index) {
    const TreeTriangle& triangle = tree_.triangles()[index];
    const Vec3 point = closest_point(triangle, query);
    const double apart = (point - query).norm();
    if (apart <= distance) found.push_back({point, triangle.face, apart});
  });
  std::ranges::sort(found, {}, [](const SurfacePoint& p) { return std::pair(p.distance, p.face); });
  return found;
}

double SurfaceTree::farthest_from(const Vec3& point) const {
  double farthest2 = 0;
  for (const TreeTriangle& triangle : tree_.triangles()) {
    for (const Vec3& corner :
         {triangle.a, Vec3(triangle.a + triangle.ab), Vec3(triangle.a + triangle.ac)}) {
      farthest2 = std::max(farthest2, (corner - point).squaredNorm());
    }
  }
  return std::sqrt(farthest2);
}

}  // namespace fracbench
