#pragma once

#include <array>

#include "core/vec3.h"

namespace fracbench {

using Point2 = std::array<double, 2>;

/// Sign of twice the area of the triangle (a, b, c): 1 where it turns counter-clockwise, -1 where
/// clockwise, 0 where the points are exactly on a line. Exact for all finite input.
int orientation(const Point2& a, const Point2& b, const Point2& c);

/// Sign of ((b - a) x (c - a)) . (d - a): 1 where d is on the side that the normal of the triangle
/// (a, b, c) points to, 0 where the points are exactly on a plane. Exact for all finite input.
int side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace fracbench
