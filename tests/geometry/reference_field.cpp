#include "tests/geometry/reference_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fracbench::reference {
namespace {

double segment_distance(const Vec3& p, const Vec3& q, const Vec3& query) {
  const Vec3 along = q - p;
  const double t = std::clamp((query - p).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (query - p - t * along).norm();
}

double triangle_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& query) {
  const Vec3 normal = (b - a).cross(c - a).normalized();
  const auto inner_side = [&](const Vec3& p, const Vec3& q) {
    return normal.cross(q - p).dot(query - p) >= 0;
  };
  if (inner_side(a, b) && inner_side(b, c) && inner_side(c, a)) {
    return std::abs(normal.dot(query - a));
  }
  return std::min({segment_distance(a, b, query), segment_distance(b, c, query),
                   segment_distance(c, a, query)});
}

}  // namespace

double distance(const TriangleMesh& mesh, const Vec3& query) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    best = std::min(
        best, triangle_distance(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2), query));
  }
  return best;
}

double winding_number(const TriangleMesh& mesh, const Vec3& query) {
  double angle = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 a = mesh.corner(f, 0) - query, b = mesh.corner(f, 1) - query,
               c = mesh.corner(f, 2) - query;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

double signed_distance(const TriangleMesh& mesh, const Vec3& query) {
  const double value = distance(mesh, query);
  return std::abs(winding_number(mesh, query)) > 0.5 ? value : -value;
}

double box_signed_distance(const Vec3& low, const Vec3& high, const Vec3& query) {
  const Vec3 outside = (low - query).cwiseMax(query - high);
  if (outside.maxCoeff() < 0) return -outside.maxCoeff();
  return -outside.cwiseMax(0).norm();
}

}  // namespace fracbench::reference
