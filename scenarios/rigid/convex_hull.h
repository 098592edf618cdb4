#pragma once

#include <span>
#include <vector>

#include "core/vec3.h"

namespace fracbench {

/// A convex polytope, and the planes of its faces: inside is normal . x <= offset.
struct ConvexHull {
  struct Plane {
    Vec3 normal;  ///< outward, unit
    double offset = 0;
  };
  std::vector<Vec3> vertices;
  std::vector<Plane> planes;
  double volume = 0;
  double inset = 0;  ///< how far the faces lie within the hull of the points, m
};

/// The hull of some points, its faces moved inwards by `inset`, or by a quarter of the largest
/// distance that leaves something where that is less. Points that span no volume give the hull with
/// no vertices.
ConvexHull convex_hull(std::span<const Vec3> points, double inset = 0);

}  // namespace fracbench
