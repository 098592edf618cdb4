#include "geometry/shell_nesting.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/sum.h"

namespace fracbench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

int sign(double value) { return (value > 0) - (value < 0); }

Kernel::Point_3 point3(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// Side of `p`, seen from above, of the line from a to b: 1 left, -1 right, 0 on it.
int side_from_above(const Vec3& a, const Vec3& b, const Vec3& p) {
  return static_cast<int>(CGAL::orientation(
      Kernel::Point_2(a.x(), a.y()), Kernel::Point_2(b.x(), b.y()), Kernel::Point_2(p.x(), p.y())));
}

/// The same for p + (e, e^2) with an infinitely small e: 0 only where a and b are one point.
int perturbed(int side, const Vec3& a, const Vec3& b) {
  if (side != 0) return side;
  if (a.y() != b.y()) return sign(a.y() - b.y());
  return sign(b.x() - a.x());
}

struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void extend(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  bool holds(const Box& other) const {
    return (low.array() <= other.low.array()).all() && (other.high.array() <= high.array()).all();
  }
};

/// Whether shell `inner` lies in shell `outer`: decided by the first of its vertices that is not on
/// the outer shell.
bool lies_in(const TriangleMesh& mesh, std::span<const std::int32_t> inner,
             std::span<const std::int32_t> outer) {
  for (const std::int32_t f : inner) {
    for (int k = 0; k < 3; ++k) {
      const PointSide side = point_side(mesh, outer, mesh.corner(f, k));
      if (side != PointSide::on_surface) return side == PointSide::inside;
    }
  }
  // Every vertex touches: the middle of a face decides, but for its rounding.
  for (const std::int32_t f : inner) {
    const Vec3 middle = (mesh.corner(f, 0) + mesh.corner(f, 1) + mesh.corner(f, 2)) / 3;
    const PointSide side = point_side(mesh, outer, middle);
    if (side != PointSide::on_surface) return side == PointSide::inside;
  }
  return false;
}

}  // namespace

PointSide point_side(const TriangleMesh& mesh, std::span<const std::int32_t> faces,
                     const Vec3& point) {
  bool inside = false;
  for (const std::int32_t f : faces) {
    const Vec3& a = mesh.corner(f, 0);
    const Vec3& b = mesh.corner(f, 1);
    const Vec3& c = mesh.corner(f, 2);
    const Vec3 low = a.cwiseMin(b).cwiseMin(c);
    const Vec3 high = a.cwiseMax(b).cwiseMax(c);
    // Only faces over or at the point count.
    if (point.x() < low.x() || point.x() > high.x() || point.y() < low.y() ||
        point.y() > high.y() || point.z() > high.z()) {
      continue;
    }
    const std::array<int, 3> sides = {side_from_above(a, b, point), side_from_above(b, c, point),
                                      side_from_above(c, a, point)};
    const bool left = sides[0] >= 0 && sides[1] >= 0 && sides[2] >= 0;
    const bool right = sides[0] <= 0 && sides[1] <= 0 && sides[2] <= 0;
    if (!left && !right) continue;
    const int above =
        static_cast<int>(CGAL::orientation(point3(a), point3(b), point3(c), point3(point)));
    if (above == 0 && point.z() >= low.z()) {
      // On the plane and over the closed triangle: on it, unless the triangle stands upright, where
      // all three sides are 0 and the box alone has been tested.
      if (left != right) return PointSide::on_surface;
      const auto drop_x = [](const Vec3& p) { return Vec3(p.y(), p.z(), 0); };
      const auto drop_y = [](const Vec3& p) { return Vec3(p.z(), p.x(), 0); };
      const auto covers = [&](const auto& drop) {
        const int s0 = side_from_above(drop(a), drop(b), drop(point));
        const int s1 = side_from_above(drop(b), drop(c), drop(point));
        const int s2 = side_from_above(drop(c), drop(a), drop(point));
        return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
      };
      if (covers(drop_x) && covers(drop_y)) return PointSide::on_surface;
    }
    const int s0 = perturbed(sides[0], a, b);
    const int s1 = perturbed(sides[1], b, c);
    const int s2 = perturbed(sides[2], c, a);
    if (s0 == 0 || s0 != s1 || s1 != s2) continue;
    // Turning left seen from above, the triangle lies over the point where the point is on the
    // negative side of its plane.
    if (above * s0 < 0) inside = !inside;
  }
  return inside ? PointSide::inside : PointSide::outside;
}

ShellNesting shell_nesting(const TriangleMesh& mesh, std::span<const std::int32_t> component) {
  const std::int32_t count =
      component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
  ShellNesting result;
  result.shells.resize(count);
  std::vector<Box> boxes(count);
  for (std::size_t f = 0; f < component.size(); ++f) {
    result.shells[component[f]].faces.push_back(static_cast<std::int32_t>(f));
    for (int k = 0; k < 3; ++k) boxes[component[f]].extend(mesh.corner(f, k));
  }
  for (std::int32_t s = 0; s < count; ++s) {
    const Vec3 apex = (boxes[s].low + boxes[s].high) / 2;
    Sum volume6;
    for (const std::int32_t f : result.shells[s].faces) {
      const Vec3 b = mesh.corner(f, 1) - apex;
      const Vec3 c = mesh.corner(f, 2) - apex;
      volume6 += (mesh.corner(f, 0) - apex).dot(b.cross(c));
    }
    result.shells[s].volume = volume6.value() / 6;
  }

  std::vector<std::vector<std::int32_t>> around(count);
  for (std::int32_t inner = 0; inner < count; ++inner) {
    for (std::int32_t outer = 0; outer < count; ++outer) {
      if (inner != outer && boxes[outer].holds(boxes[inner]) &&
          lies_in(mesh, result.shells[inner].faces, result.shells[outer].faces)) {
        around[inner].push_back(outer);
      }
    }
    result.shells[inner].depth = static_cast<std::int32_t>(around[inner].size());
  }
  for (std::int32_t s = 0; s < count; ++s) {
    for (const std::int32_t outer : around[s]) {
      std::int32_t& parent = result.shells[s].parent;
      if (parent < 0 || result.shells[outer].depth > result.shells[parent].depth) parent = outer;
    }
  }
  return result;
}

}  // namespace fracbench
