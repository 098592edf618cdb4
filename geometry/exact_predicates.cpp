#include "geometry/exact_predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>

namespace fracbench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Bounds on the rounding of the two determinants as multiples of the sum of the absolute values of
// their terms (J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust
// geometric predicates", 1997), a little enlarged.
constexpr double bound_2d = 3.4e-16;
constexpr double bound_3d = 7.9e-16;
// Terms below this may have lost digits to underflow, which those bounds do not know of.
constexpr double smallest_safe_term = 1e-280;

int sign(double value) { return (value > 0) - (value < 0); }

int exact_orientation(const Point2& a, const Point2& b, const Point2& c) {
  using Point = Kernel::Point_2;
  return CGAL::orientation(Point(a[0], a[1]), Point(b[0], b[1]), Point(c[0], c[1]));
}

int exact_side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto point = [](const Vec3& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  return CGAL::orientation(point(a), point(b), point(c), point(d));
}

}  // namespace

int orientation(const Point2& a, const Point2& b, const Point2& c) {
  // The signs of differences are exact, hence those of the two terms; where they are opposite, or
  // one is 0, they decide. This is the common case for axis-aligned shapes.
  const double left_0 = a[0] - c[0], left_1 = b[1] - c[1];
  const double right_0 = a[1] - c[1], right_1 = b[0] - c[0];
  const int left_sign = sign(left_0) * sign(left_1);
  const int right_sign = sign(right_0) * sign(right_1);
  if (left_sign != right_sign) return left_sign > right_sign ? 1 : -1;
  if (left_sign == 0) return 0;

  const double left = left_0 * left_1, right = right_0 * right_1;
  const double size = std::abs(left) + std::abs(right);
  const double determinant = left - right;
  if (size > smallest_safe_term && std::abs(determinant) > bound_2d * size) {
    return sign(determinant);
  }
  return exact_orientation(a, b, c);
}

int side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double x1 = u.y() * v.z(), x2 = u.z() * v.y();
  const double y1 = u.z() * v.x(), y2 = u.x() * v.z();
  const double z1 = u.x() * v.y(), z2 = u.y() * v.x();
  const double determinant = (x1 - x2) * w.x() + (y1 - y2) * w.y() + (z1 - z2) * w.z();
  const double size = (std::abs(x1) + std::abs(x2)) * std::abs(w.x()) +
                      (std::abs(y1) + std::abs(y2)) * std::abs(w.y()) +
                      (std::abs(z1) + std::abs(z2)) * std::abs(w.z());
  if (size > smallest_safe_term && std::abs(determinant) > bound_3d * size) {
    return sign(determinant);
  }
  return exact_side_of_plane(a, b, c, d);
}

}  // namespace fracbench
