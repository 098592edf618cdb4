#include "methods/cvd/winding.h"

#include <cmath>
#include <numbers>

#include "core/sum.h"

namespace fracbench::cvd {

double winding_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point) {
  const Vec3 x = a - point, y = b - point, z = c - point;
  const double lx = x.norm(), ly = y.norm(), lz = z.norm();
  const double denominator = lx * ly * lz + x.dot(y) * lz + y.dot(z) * lx + z.dot(x) * ly;
  return std::atan2(x.dot(y.cross(z)), denominator) / (2 * std::numbers::pi);
}

double winding_number(const TriangleMesh& mesh, const Vec3& point) {
  Sum sum;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    sum += winding_of_triangle(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2), point);
  }
  return sum.value();
}

}  // namespace fracbench::cvd
