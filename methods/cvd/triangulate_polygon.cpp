#include <algorithm>

#include "methods/cvd/predicates.h"
#include "methods/cvd/project.h"
#include "methods/cvd/triangulate.h"

namespace fracbench::cvd {

namespace {

// Twice the area over the sum of squared sides: 0 for a needle, largest for an equilateral one.
double shape_quality(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return sides > 0 ? (b - a).cross(c - a).norm() / sides : 0;
}

}  // namespace

std::vector<Face> triangulate_polygon(std::span<const Vec3> vertices,
                                      std::span<const std::int32_t> polygon, const Vec3& normal) {
  std::vector<std::int32_t> rest(polygon.begin(), polygon.end());
  const Axes axes = dominant_axes(normal);
  std::vector<Face> faces;
  while (rest.size() > 3) {
    const std::size_t size = rest.size();
    std::size_t best = 0;
    double best_score = -2;
    for (std::size_t n = 0; n < size; ++n) {
      const Vec3& a = vertices[rest[(n + size - 1) % size]];
      const Vec3& b = vertices[rest[n]];
      const Vec3& c = vertices[rest[(n + 1) % size]];
      // An ear must be rightly turned, and must not leave a straight rest behind.
      bool good = turn(a, b, c, axes.u, axes.v) > 0;
      double score = good ? shape_quality(a, b, c) : -1;
      if (good) {
        bool blocked = false, solid = false;
        for (std::size_t m = 2; m + 1 < size; ++m) {
          const Vec3& p = vertices[rest[(n + m) % size]];
          const bool beyond = turn(c, a, p, axes.u, axes.v) > 0;
          solid |= turn(a, c, p, axes.u, axes.v) > 0;
          blocked |=
              beyond && turn(a, b, p, axes.u, axes.v) >= 0 && turn(b, c, p, axes.u, axes.v) >= 0;
        }
        if (blocked || !solid) score = -1;
      }
      if (score > best_score) {
        best_score = score;
        best = n;
      }
    }
    faces.push_back({rest[(best + size - 1) % size], rest[best], rest[(best + 1) % size]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  }
  faces.push_back({rest[0], rest[1], rest[2]});
  return faces;
}

}  // namespace fracbench::cvd
