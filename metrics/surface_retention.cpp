#include "metrics/surface_retention.h"

#include <algorithm>
#include <array>

#include "core/parallel.h"
#include "core/sum.h"
#include "geometry/measures.h"
#include "geometry/surface_distance.h"
#include "geometry/triangle_tree.h"
#include "metrics/measurement.h"

namespace fracbench {
namespace {

TreeTriangle triangle_of(const TriangleMesh& mesh, std::size_t face) {
  const Vec3& a = mesh.corner(face, 0);
  const Vec3 ab = mesh.corner(face, 1) - a;
  const Vec3 ac = mesh.corner(face, 2) - a;
  return {.a = a,
          .ab = ab,
          .ac = ac,
          .normal = ab.cross(ac).stableNormalized(),
          .abab = ab.dot(ab),
          .abac = ab.dot(ac),
          .acac = ac.dot(ac),
          .face = static_cast<std::int32_t>(face)};
}

std::array<Vec3, 4> samples(const TriangleMesh& mesh, std::size_t face) {
  const Vec3& a = mesh.corner(face, 0);
  const Vec3& b = mesh.corner(face, 1);
  const Vec3& c = mesh.corner(face, 2);
  return {a, b, c, (a + b + c) / 3};
}

double longest_edge(const TriangleMesh& mesh, std::size_t face) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    longest = std::max(longest, (mesh.corner(face, k) - mesh.corner(face, (k + 1) % 3)).norm());
  }
  return longest;
}

bool looks_the_same_way(const TriangleMesh& mesh, std::size_t face, const Vec3& expected,
                        double tolerance) {
  const Vec3 normal = area_vector2(mesh, face);
  if (normal.norm() <= tolerance * longest_edge(mesh, face)) return true;
  return normal.dot(expected) > 0;
}

struct Kept {
  double area = 0;                 // m^2
  std::vector<Vec3> off_the_face;  // samples that are not on the face that their tag names
  double on_the_face = 0;          // largest distance of the others to that face, m
};

Kept kept_surface(const TriangleMesh& body, const Fragment& fragment, double tolerance) {
  Kept kept;
  Sum area;
  for (std::size_t f = 0; f < fragment.faces.size(); ++f) {
    const std::int32_t source = fragment.faces[f].original_face;
    if (source < 0) continue;
    const std::array<Vec3, 4> points = samples(fragment.mesh, f);
    if (source >= static_cast<std::int32_t>(body.faces.size())) {
      kept.off_the_face.insert(kept.off_the_face.end(), points.begin(), points.end());
      continue;
    }
    const TreeTriangle triangle = triangle_of(body, source);
    double largest = 0;
    for (const Vec3& p : points) {
      largest = std::max(largest, std::sqrt(squared_distance(triangle, p)));
    }
    if (largest > tolerance) {
      kept.off_the_face.insert(kept.off_the_face.end(), points.begin(), points.end());
    } else {
      kept.on_the_face = std::max(kept.on_the_face, largest);
      if (looks_the_same_way(fragment.mesh, f, area_vector2(body, source), tolerance)) {
        area += area_vector2(fragment.mesh, f).norm() / 2;
      }
    }
  }
  kept.area = area.value();
  return kept;
}

// Most vertices of the body are vertices of fragments, bit for bit, and need no search.
std::vector<Vec3> vertices_not_kept(const TriangleMesh& body, const TriangleMesh& fragments) {
  using Key = std::array<double, 3>;
  const auto key = [](const Vec3& v) { return Key{v.x(), v.y(), v.z()}; };
  std::vector<Key> known;
  known.reserve(fragments.vertices.size());
  for (const Vec3& v : fragments.vertices) known.push_back(key(v));
  std::ranges::sort(known);
  std::vector<Vec3> missing;
  for (const Vec3& v : body.vertices) {
    if (!std::ranges::binary_search(known, key(v))) missing.push_back(v);
  }
  return missing;
}

// Only vertices that faces use.
TriangleMesh joined(const std::vector<std::reference_wrapper<const Fragment>>& fragments) {
  TriangleMesh all;
  for (const Fragment& fragment : fragments) {
    std::vector<std::int32_t> place(fragment.mesh.vertices.size(), -1);
    for (Face face : fragment.mesh.faces) {
      for (std::int32_t& v : face) {
        if (place[v] < 0) {
          place[v] = static_cast<std::int32_t>(all.vertices.size());
          all.vertices.push_back(fragment.mesh.vertices[v]);
        }
        v = place[v];
      }
      all.faces.push_back(face);
    }
  }
  return all;
}

double largest_distance(const std::vector<Vec3>& points, const TriangleMesh& mesh, int threads) {
  if (points.empty()) return 0;
  const SurfaceDistance surface(mesh);
  std::vector<double> distances(points.size());
  parallel_for(
      points.size(), threads,
      [&](std::size_t i) { distances[i] = surface.nearest(points[i]).distance; }, 64);
  return std::ranges::max(distances);
}

}  // namespace

MetricInfo SurfaceRetention::info() const {
  return {
      .name = "surface_retention",
      .summary = "share of the original surface that the fragments carry, and how far off it is"};
}

Measurement SurfaceRetention::measure(const CellResult& cell) const {
  const double tolerance = kRetentionTolerance * bounding_box(cell.body).longest_side();
  const auto fragments = measurable(cell.fragments);
  std::vector<Kept> kept(fragments.size());
  parallel_for(fragments.size(), cell.threads,
               [&](std::size_t i) { kept[i] = kept_surface(cell.body, fragments[i], tolerance); });
  Sum area_kept;
  double distance = 0;
  std::vector<Vec3> off_the_face;
  for (const Kept& part : kept) {
    area_kept += part.area;
    distance = std::max(distance, part.on_the_face);
    off_the_face.insert(off_the_face.end(), part.off_the_face.begin(), part.off_the_face.end());
  }
  Measurement result;
  add_value(result, "surface_retention", area_kept.value() / area(cell.body));
  const TriangleMesh all = joined(fragments);
  if (all.empty()) return result;
  distance = std::max({distance, largest_distance(off_the_face, cell.body, cell.threads),
                       largest_distance(vertices_not_kept(cell.body, all), all, cell.threads)});
  add_value(result, "surface_distance", distance, "m");
  return result;
}

}  // namespace fracbench
