#pragma once

#include <cstdint>
#include <vector>

#include "geometry/triangle_tree.h"

namespace fracbench {

/// A point of a mesh's surface.
struct SurfacePoint {
  Vec3 point = Vec3::Zero();
  std::int32_t face = -1;
  double distance = 0;  ///< from the query, m
};

/// The surface of a mesh, for what a ball that touches it must know: the nearest point, and
/// everything within the ball. The mesh must not be empty.
class SurfaceTree {
 public:
  explicit SurfaceTree(const TriangleMesh& mesh) : tree_(mesh) {}

  /// The point of the surface nearest to `query`; of equally near ones that of the lowest face.
  SurfacePoint nearest(const Vec3& query) const;

  /// The nearest point of every face that is within `distance` of `query`, nearest first.
  std::vector<SurfacePoint> within(const Vec3& query, double distance) const;

  /// The largest distance of any point of the surface from `point`, m.
  double farthest_from(const Vec3& point) const;

 private:
  TriangleTree tree_;
};

}  // namespace fracbench
