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

// Corners, centroid and middles of the edges.
std::array<Vec3, 7> samples(const TriangleMesh& mesh, std::size_t face) {
  const Vec3& a = mesh.corner(face, 0);
  const Vec3& b = mesh.corner(face, 1);
  const Vec3& c = mesh.corner(face, 2);
  return {a, b, c, (a + b + c) / 3, (a + b) / 2, (b + c) / 2, (c + a) / 2};
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
  double area = 0;                  // m^2
  double distance = 0;              // largest one of a sample to the body's surface, m
  std::vector<std::size_t> astray;  // faces that are not on the face that their tag names
};

// Faces that lie on the face that their tag names.
Kept on_named_faces(const TriangleMesh& body, const Fragment& fragment, double tolerance) {
  Kept kept;
  Sum area;
  for (std::size_t f = 0; f < fragment.faces.size(); ++f) {
    const std::int32_t source = fragment.faces[f].original_face;
    if (source < 0) continue;
    if (source >= static_cast<std::int32_t>(body.faces.size())) {
      kept.astray.push_back(f);
      continue;
    }
    const TreeTriangle triangle = triangle_of(body, source);
    double largest = 0;
    for (const Vec3& p : samples(fragment.mesh, f)) {
      largest = std::max(largest, std::sqrt(squared_distance(triangle, p)));
    }
    if (largest > tolerance) {
      kept.astray.push_back(f);
      continue;
    }
    kept.distance = std::max(kept.distance, largest);
    if (looks_the_same_way(fragment.mesh, f, area_vector2(body, source), tolerance)) {
      area += area_vector2(fragment.mesh, f).norm() / 2;
    }
  }
  kept.area = area.value();
  return kept;
}

// Of the others, those that lie on the body's surface all the same: a tool may have divided flat
// parts of the surface anew, so that its faces span several of the body's.
Kept on_surface(const TriangleMesh& body, const SurfaceDistance& surface, const Fragment& fragment,
                const std::vector<std::size_t>& faces, double tolerance) {
  Kept kept;
  Sum area;
  for (const std::size_t f : faces) {
    double largest = 0;
    std::int32_t below_centroid = -1;
    const auto points = samples(fragment.mesh, f);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const SurfaceDistance::Nearest nearest = surface.nearest(points[k]);
      largest = std::max(largest, nearest.distance);
      if (k == 3) below_centroid = nearest.face;
    }
    kept.distance = std::max(kept.distance, largest);
    if (largest > tolerance) continue;
    if (looks_the_same_way(fragment.mesh, f, area_vector2(body, below_centroid), tolerance)) {
      area += area_vector2(fragment.mesh, f).norm() / 2;
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
  parallel_for(fragments.size(), cell.threads, [&](std::size_t i) {
    kept[i] = on_named_faces(cell.body, fragments[i], tolerance);
  });
  Sum area_kept;
  double distance = 0;
  const auto add = [&](const Kept& part) {
    area_kept += part.area;
    distance = std::max(distance, part.distance);
  };
  std::ranges::for_each(kept, add);
  if (std::ranges::any_of(kept, [](const Kept& part) { return !part.astray.empty(); })) {
    const SurfaceDistance surface(cell.body);
    std::vector<Kept> rest(fragments.size());
    parallel_for(fragments.size(), cell.threads, [&](std::size_t i) {
      rest[i] = on_surface(cell.body, surface, fragments[i], kept[i].astray, tolerance);
    });
    std::ranges::for_each(rest, add);
  }
  Measurement result;
  add_value(result, "surface_retention", area_kept.value() / area(cell.body));
  const TriangleMesh all = joined(fragments);
  if (all.empty()) return result;
  distance =
      std::max(distance, largest_distance(vertices_not_kept(cell.body, all), all, cell.threads));
  add_value(result, "surface_distance", distance, "m");
  return result;
}

}  // namespace fracbench
