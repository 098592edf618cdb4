#include "methods/bem/hertz.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "geometry/edge_table.h"

namespace fracbench::bem {
namespace {

// Twice the signed area of the part of the flat triangle (0, a, b) within `radius` of 0; a and b in
// the plane, as pairs.
double doubled_sector(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius) {
  const auto turned = [](const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
    return u.x() * v.y() - u.y() * v.x();
  };
  const auto round = [&](const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
    return radius * radius * std::atan2(turned(u, v), u.dot(v));
  };
  // Where a + s (b - a) enters and leaves the circle.
  const Eigen::Vector2d way = b - a;
  const double length = way.squaredNorm();
  if (length == 0) return 0;
  const double middle = -a.dot(way) / length;
  const double discriminant = middle * middle - (a.squaredNorm() - radius * radius) / length;
  if (discriminant <= 0) return round(a, b);
  const double root = std::sqrt(discriminant);
  const double enter = std::clamp(middle - root, 0.0, 1.0);
  const double leave = std::clamp(middle + root, 0.0, 1.0);
  if (enter >= leave) return round(a, b);
  const Eigen::Vector2d p = a + enter * way;
  const Eigen::Vector2d q = a + leave * way;
  return (enter > 0 ? round(a, p) : 0) + turned(p, q) + (leave < 1 ? round(q, b) : 0);
}

// Length of the part of a segment within `radius` of `centre`.
double length_in_ball(const Vec3& from, const Vec3& to, const Vec3& centre, double radius) {
  const Vec3 way = to - from;
  const double length = way.squaredNorm();
  if (length == 0) return 0;
  const Vec3 start = from - centre;
  const double middle = -start.dot(way) / length;
  const double discriminant = middle * middle - (start.squaredNorm() - radius * radius) / length;
  if (discriminant <= 0) return 0;
  const double root = std::sqrt(discriminant);
  return std::sqrt(length) *
         std::max(0.0, std::min(1.0, middle + root) - std::max(0.0, middle - root));
}

}  // namespace

double contact_duration(const HertzContact& contact) {
  return 2.87 * std::pow(contact.mass * contact.mass /
                             (contact.modulus * contact.modulus * contact.radius * contact.speed),
                         0.2);
}

double contact_radius(const HertzContact& contact) {
  const double depth = std::pow(15 * contact.mass * contact.speed * contact.speed /
                                    (16 * contact.modulus * std::sqrt(contact.radius)),
                                0.4);
  return std::sqrt(contact.radius * depth);
}

double effective_mass(double mass, const Mat3& inertia, const Vec3& centre, const Vec3& point,
                      const Vec3& direction) {
  const Vec3 arm = (point - centre).cross(direction);
  return 1 / (1 / mass + arm.dot(inertia.ldlt().solve(arm)));
}

double mean_curvature(const BoundaryElements& elements, const Vec3& point, const Vec3& normal,
                      double reach) {
  const auto faces = [&](std::int32_t k) { return elements.normals[k].dot(normal) > 0; };
  double area = 0;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    if (faces(static_cast<std::int32_t>(k)) &&
        (elements.centroids[k] - point).norm() < reach + elements.radii[k]) {
      area += area_in_ball(elements.corners(k), point, reach);
    }
  }
  if (area <= 0) return 0;
  double sum = 0;
  const EdgeTable edges({elements.vertices, elements.triangles});
  edges.for_each_edge(
      [&](std::int32_t low, std::int32_t high, std::span<const EdgeTable::Side> sides) {
        if (sides.size() != 2 || !faces(sides[0].face) || !faces(sides[1].face)) return;
        const double length =
            length_in_ball(elements.vertices[low], elements.vertices[high], point, reach);
        if (length == 0) return;
        const Vec3& first = elements.normals[sides[0].face];
        const Vec3& second = elements.normals[sides[1].face];
        const double angle = std::atan2(first.cross(second).norm(), first.dot(second));
        const Vec3 across = elements.centroids[sides[1].face] - elements.centroids[sides[0].face];
        // Bulging out where the second triangle falls below the plane of the first.
        sum += (across.dot(first) <= across.dot(second) ? 0.5 : -0.5) * length * angle;
      });
  return sum / area;
}

double area_in_ball(const Corners& corners, const Vec3& centre, double radius) {
  const Vec3 u = (corners[1] - corners[0]).normalized();
  const Vec3 normal = u.cross(corners[2] - corners[0]).normalized();
  const Vec3 v = normal.cross(u);
  const double height = (centre - corners[0]).dot(normal);
  const double squared = radius * radius - height * height;
  if (!(squared > 0)) return 0;
  const double in_plane = std::sqrt(squared);
  std::array<Eigen::Vector2d, 3> flat;
  for (int k = 0; k < 3; ++k) {
    const Vec3 from = corners[k] - centre;
    flat[k] = {from.dot(u), from.dot(v)};
  }
  double doubled = 0;
  for (int k = 0; k < 3; ++k) doubled += doubled_sector(flat[k], flat[(k + 1) % 3], in_plane);
  return std::max(0.0, doubled / 2);
}

}  // namespace fracbench::bem
