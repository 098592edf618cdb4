#include "methods/modes/validation/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace fracbench::modes {
namespace {

struct Polygon {
  std::vector<std::array<double, 2>> corners;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise
  std::vector<std::array<int, 2>> edges;      ///< of its boundary, the inside to their left
};

Polygon closed_polygon(std::vector<std::array<double, 2>> corners,
                       std::vector<std::array<int, 3>> triangles) {
  Polygon polygon{std::move(corners), std::move(triangles), {}};
  const int n = static_cast<int>(polygon.corners.size());
  for (int i = 0; i < n; ++i) polygon.edges.push_back({i, (i + 1) % n});
  return polygon;
}

/// The prism over the polygon between z = 0 and z = height.
TriangleMesh extrusion(const Polygon& polygon, double height) {
  TriangleMesh mesh;
  const auto n = static_cast<std::int32_t>(polygon.corners.size());
  for (const double z : {0.0, height}) {
    for (const auto& [x, y] : polygon.corners) mesh.vertices.emplace_back(x, y, z);
  }
  for (const auto& [a, b, c] : polygon.triangles) {
    mesh.faces.push_back({c, b, a});
    mesh.faces.push_back({a + n, b + n, c + n});
  }
  for (const auto& [a, b] : polygon.edges) {
    mesh.faces.push_back({a, b, b + n});
    mesh.faces.push_back({a, b + n, a + n});
  }
  return mesh;
}

}  // namespace

TriangleMesh plain_bar() {
  return extrusion(closed_polygon({{0, 0}, {4, 0}, {4, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}}), 1);
}

TriangleMesh notched_bar() {
  return extrusion(
      closed_polygon({{0, 0}, {4, 0}, {4, 1}, {2.1, 1}, {2.1, 0.5}, {1.9, 0.5}, {1.9, 1}, {0, 1}},
                     {{0, 5, 6}, {0, 6, 7}, {0, 1, 5}, {1, 4, 5}, {1, 2, 4}, {2, 3, 4}}),
      1);
}

TriangleMesh l_shape() {
  return extrusion(closed_polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                                  {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}),
                   0.5);
}

TriangleMesh plate_with_hole() {
  // A ring of quadrilaterals between the hole's corners and the points of the square's boundary in
  // the same directions, the square's corners among them.
  constexpr int segments = 48;
  Polygon ring;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    const double c = std::cos(angle), s = std::sin(angle);
    ring.corners.push_back({0.3 * c, 0.3 * s});
    const double reach = std::max(std::abs(c), std::abs(s));
    ring.corners.push_back({c / reach, s / reach});
  }
  for (int i = 0; i < segments; ++i) {
    const int in = 2 * i, out = 2 * i + 1;
    const int next_in = 2 * ((i + 1) % segments), next_out = next_in + 1;
    ring.triangles.push_back({in, out, next_out});
    ring.triangles.push_back({in, next_out, next_in});
    ring.edges.push_back({out, next_out});
    ring.edges.push_back({next_in, in});
  }
  return extrusion(ring, 0.3);
}

TriangleMesh dumbbell() {
  return extrusion(closed_polygon({{0, 0},
                                   {1, 0},
                                   {1, 0.35},
                                   {1.6, 0.35},
                                   {1.6, 0},
                                   {2.6, 0},
                                   {2.6, 1},
                                   {1.6, 1},
                                   {1.6, 0.65},
                                   {1, 0.65},
                                   {1, 1},
                                   {0, 1}},
                                  {{0, 1, 2},
                                   {0, 2, 9},
                                   {0, 9, 10},
                                   {0, 10, 11},
                                   {2, 3, 8},
                                   {2, 8, 9},
                                   {6, 7, 8},
                                   {6, 8, 3},
                                   {6, 3, 4},
                                   {6, 4, 5}}),
                   1);
}

}  // namespace fracbench::modes
