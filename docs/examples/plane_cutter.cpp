// A fracture method as a shared library: cuts a body in two by a plane through the point that was
// hit (docs/add-a-method.md). Build it with
//
//     g++ -std=c++20 -shared -fPIC -I methods/plugin docs/examples/plane_cutter.cpp -o cutter.so
//
// The plane turns about the impulse by a random angle. The cut is closed by a fan, so the body has
// to be convex.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "fracbench_plugin.h"

namespace {

using Vec = std::array<double, 3>;

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec scaled(const Vec& a, double factor) { return {factor * a[0], factor * a[1], factor * a[2]}; }
Vec sum(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec vec(const double (&a)[3]) { return {a[0], a[1], a[2]}; }

struct Mesh {
  std::vector<Vec> vertices;
  std::vector<std::array<std::int32_t, 3>> faces;
};

/// The part of the closed mesh where heights are positive.
Mesh half(const Mesh& body, const std::vector<double>& heights) {
  Mesh part{body.vertices, {}};
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> crossings;
  const auto point_between = [&](std::int32_t a, std::int32_t b) {
    const std::int32_t low = std::min(a, b), high = std::max(a, b);
    const auto [at, is_new] =
        crossings.try_emplace({low, high}, static_cast<std::int32_t>(part.vertices.size()));
    if (is_new) {
      const double t = heights[low] / (heights[low] - heights[high]);
      part.vertices.push_back(
          sum(scaled(body.vertices[low], 1 - t), scaled(body.vertices[high], t)));
    }
    return at->second;
  };
  std::vector<std::array<std::int32_t, 2>> rim;
  for (const auto& face : body.faces) {
    std::vector<std::int32_t> polygon;
    std::array<std::int32_t, 2> ends{-1, -1};  // where the face leaves the part and comes back
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = face[k], b = face[(k + 1) % 3];
      if (heights[a] > 0) polygon.push_back(a);
      if ((heights[a] > 0) != (heights[b] > 0)) {
        polygon.push_back(point_between(a, b));
        ends[heights[a] > 0 ? 0 : 1] = polygon.back();
      }
    }
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      part.faces.push_back({polygon[0], polygon[k - 1], polygon[k]});
    }
    if (ends[0] >= 0) rim.push_back(ends);
  }
  if (!rim.empty()) {
    Vec middle{};
    for (const auto& [from, to] : rim) {
      middle = sum(middle, scaled(part.vertices[from], 1.0 / static_cast<double>(rim.size())));
    }
    const auto centre = static_cast<std::int32_t>(part.vertices.size());
    part.vertices.push_back(middle);
    for (const auto& [from, to] : rim) part.faces.push_back({to, from, centre});
  }
  // Without the vertices of the other part.
  std::vector<std::int32_t> number(part.vertices.size(), -1);
  Mesh result;
  for (auto face : part.faces) {
    for (std::int32_t& v : face) {
      if (number[v] < 0) {
        number[v] = static_cast<std::int32_t>(result.vertices.size());
        result.vertices.push_back(part.vertices[v]);
      }
      v = number[v];
    }
    result.faces.push_back(face);
  }
  return result;
}

}  // namespace

extern "C" std::int32_t fracbench_plugin_version() { return FRACBENCH_PLUGIN_VERSION; }

extern "C" void* fracbench_plugin_prepare(const fracbench_mesh* body, const fracbench_material*,
                                          const char*, const fracbench_host*) {
  auto* copy = new Mesh;
  for (std::int64_t v = 0; v < body->vertex_count; ++v) {
    const double* p = body->vertices + 3 * v;
    copy->vertices.push_back({p[0], p[1], p[2]});
  }
  for (std::int64_t f = 0; f < body->face_count; ++f) {
    const std::int32_t* face = body->faces + 3 * f;
    copy->faces.push_back({face[0], face[1], face[2]});
  }
  return copy;
}

extern "C" void fracbench_plugin_fracture(void* prepared, const fracbench_impact* impact,
                                          const fracbench_host* host) {
  const Mesh& body = *static_cast<const Mesh*>(prepared);
  const Vec direction = vec(impact->impulses[0].direction);
  const Vec point = vec(impact->impulses[0].point);
  const Vec axis = std::abs(direction[0]) < 0.9 ? Vec{1, 0, 0} : Vec{0, 1, 0};
  const Vec across = cross(direction, axis);
  const Vec side = scaled(across, 1 / std::sqrt(dot(across, across)));
  std::mt19937_64 chance(impact->seed);
  // By hand, since std::uniform_real_distribution differs between libraries.
  const double angle = 3.14159265358979 * static_cast<double>(chance() >> 11) * 0x1p-53;
  const Vec normal =
      sum(scaled(side, std::cos(angle)), scaled(cross(direction, side), std::sin(angle)));

  for (const double sign : {1.0, -1.0}) {
    std::vector<double> heights;
    for (const Vec& v : body.vertices) {
      const double height = dot(normal, v) - dot(normal, point);
      // No vertex lies in the plane.
      heights.push_back(sign * (std::abs(height) > 1e-9 ? height : 1e-9));
    }
    const Mesh part = half(body, heights);
    if (part.faces.empty()) continue;
    const fracbench_mesh fragment{
        static_cast<std::int64_t>(part.vertices.size()), part.vertices.data()->data(),
        static_cast<std::int64_t>(part.faces.size()), part.faces.data()->data()};
    host->add_fragment(host->handle, &fragment);
  }
}

extern "C" void fracbench_plugin_release(void* prepared) { delete static_cast<Mesh*>(prepared); }
