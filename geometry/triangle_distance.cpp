#include <algorithm>

#include "geometry/triangle_tree.h"

namespace fracbench {
namespace {

/// A point a + v ab + w ac of a triangle; in the interior, v and w are not needed.
struct Place {
  bool interior = false;
  double v = 0, w = 0;
};

Vec3 at(const TreeTriangle& t, const Place& place) { return t.a + place.v * t.ab + place.w * t.ac; }

/// The best of the three edges, for needles, where the general tests drown in rounding.
Place closest_on_edges(const TreeTriangle& t, const Vec3& query) {
  const auto along = [](double dot, double length2) {
    return length2 > 0 ? std::clamp(dot / length2, 0.0, 1.0) : 0.0;
  };
  const Vec3 ap = query - t.a;
  const Vec3 bc = t.ac - t.ab;
  const double on_bc = along((ap - t.ab).dot(bc), bc.squaredNorm());
  const Place candidates[] = {{false, along(ap.dot(t.ab), t.abab), 0},
                              {false, 0, along(ap.dot(t.ac), t.acac)},
                              {false, 1 - on_bc, on_bc}};
  return *std::min_element(
      std::begin(candidates), std::end(candidates), [&](const Place& l, const Place& r) {
        return (query - at(t, l)).squaredNorm() < (query - at(t, r)).squaredNorm();
      });
}

Place closest_place(const TreeTriangle& t, const Vec3& query) {
  const Vec3 ap = query - t.a;
  const double d1 = t.ab.dot(ap), d2 = t.ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {false, 0, 0};
  const double d3 = d1 - t.abab, d4 = d2 - t.abac;
  if (d3 >= 0 && d4 <= d3) return {false, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && t.abab > 0) return {false, d1 / t.abab, 0};
  const double d5 = d1 - t.abac, d6 = d2 - t.acac;
  if (d6 >= 0 && d5 <= d6) return {false, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && t.acac > 0) return {false, 0, d2 / t.acac};
  const double va = d3 * d6 - d5 * d4;
  const double from_b = d4 - d3, from_c = d5 - d6;
  if (va <= 0 && from_b >= 0 && from_c >= 0 && from_b + from_c > 0) {
    const double w = from_b / (from_b + from_c);
    return {false, 1 - w, w};
  }
  if (va > 0 && vb > 0 && vc > 0 && !t.normal.isZero(0)) return {true};
  return closest_on_edges(t, query);
}

}  // namespace

double squared_distance(const TreeTriangle& triangle, const Vec3& query) {
  const Place place = closest_place(triangle, query);
  if (place.interior) {
    const double height = triangle.normal.dot(query - triangle.a);
    return height * height;
  }
  return (query - at(triangle, place)).squaredNorm();
}

Vec3 closest_point(const TreeTriangle& triangle, const Vec3& query) {
  const Place place = closest_place(triangle, query);
  if (!place.interior) return at(triangle, place);
  return query - triangle.normal.dot(query - triangle.a) * triangle.normal;
}

}  // namespace fracbench
