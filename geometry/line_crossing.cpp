#include "geometry/line_crossing.h"

#include <algorithm>

#include "geometry/exact_predicates.h"

namespace fracbench {
namespace {

/// The side of the edge from u to v, seen along x, that the displaced line is on: 1 left, -1 right,
/// 0 where the edge is parallel to the line.
int side_of_edge(const Vec3& u, const Vec3& v, double y, double z) {
  const int side = orientation({u.y(), u.z()}, {v.y(), v.z()}, {y, z});
  if (side != 0) return side;
  // The derivatives of the orientation by the displacements along y and z.
  if (u.z() != v.z()) return u.z() > v.z() ? 1 : -1;
  if (u.y() != v.y()) return v.y() > u.y() ? 1 : -1;
  return 0;
}

}  // namespace

int line_crossing(const Vec3& a, const Vec3& b, const Vec3& c, double y, double z) {
  if (y < std::min({a.y(), b.y(), c.y()}) || y > std::max({a.y(), b.y(), c.y()}) ||
      z < std::min({a.z(), b.z(), c.z()}) || z > std::max({a.z(), b.z(), c.z()})) {
    return 0;
  }
  const int side = side_of_edge(a, b, y, z);
  if (side == 0 || side_of_edge(b, c, y, z) != side || side_of_edge(c, a, y, z) != side) return 0;
  return side;
}

bool is_beyond(const Vec3& a, const Vec3& b, const Vec3& c, int crossing, const Vec3& point) {
  if (point.x() > std::max({a.x(), b.x(), c.x()})) return true;
  if (point.x() < std::min({a.x(), b.x(), c.x()})) return false;
  return side_of_plane(a, b, c, point) == crossing;
}

}  // namespace fracbench
