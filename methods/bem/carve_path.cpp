#include "methods/bem/carve_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "geometry/measures.h"
#include "geometry/triangle_tree.h"

namespace fracbench::bem {
namespace {

/// Nearer than this part of an edge to its end, a crossing becomes the end itself.
constexpr double kSnap = 0.25;
/// Normals that differ by more than this cosine (about 30 degrees) make a sharp edge.
constexpr double kSharp = 0.87;

/// Four times the area over the sum of the squared sides, times sqrt(3): 1 for an equilateral
/// triangle, 0 for a flat one.
double quality(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return sides > 0 ? 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / sides : 0;
}

}  // namespace

CarvedSurface::CarvedSurface(TriangleMesh closed_surface)
    : mesh_(std::move(closed_surface)),
      some_face_(mesh_.vertices.size(), -1),
      on_path_(mesh_.vertices.size(), false) {
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
    set_face(static_cast<std::int32_t>(f), mesh_.faces[f]);
    source_.push_back(static_cast<std::int32_t>(f));
  }
}

void CarvedSurface::set_face(std::int32_t face, const Face& corners) {
  mesh_.faces[face] = corners;
  for (int k = 0; k < 3; ++k) {
    face_of_[{corners[k], corners[(k + 1) % 3]}] = face;
    some_face_[corners[k]] = face;
  }
}

std::int32_t CarvedSurface::face_left_of(std::int32_t from, std::int32_t to) const {
  const auto found = face_of_.find({from, to});
  if (found == face_of_.end()) {
    throw MethodFailure("the surface is no longer closed where a crack's mouth was carved into it");
  }
  return found->second;
}

std::vector<std::int32_t> CarvedSurface::faces_around(std::int32_t vertex) const {
  std::vector<std::int32_t> faces;
  std::int32_t face = some_face_[vertex];
  do {
    faces.push_back(face);
    const Face& f = mesh_.faces[face];
    const int k = f[0] == vertex ? 0 : f[1] == vertex ? 1 : 2;
    face = face_left_of(vertex, f[(k + 2) % 3]);  // across the edge that ends at the vertex
  } while (face != faces.front() && faces.size() <= mesh_.faces.size());
  return faces;
}

bool CarvedSurface::may_move(std::int32_t vertex, const Vec3& to) const {
  if (on_path_[vertex]) return false;
  const std::vector<std::int32_t> faces = faces_around(vertex);
  Vec3 first = Vec3::Zero();
  for (const std::int32_t f : faces) {
    const Vec3 normal = area_vector2(mesh_, f).normalized();
    if (f == faces.front()) first = normal;
    if (normal.dot(first) < kSharp) return false;
    std::array<Vec3, 3> corners;
    for (int k = 0; k < 3; ++k) {
      corners[k] = mesh_.faces[f][k] == vertex ? to : mesh_.corner(f, k);
    }
    const Vec3 moved = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (moved.normalized().dot(normal) < kSharp) return false;
    if (quality(corners[0], corners[1], corners[2]) < 0.15) return false;
  }
  return true;
}

std::optional<CarvedSurface::Stop> CarvedSurface::exit(std::int32_t face, const Vec3& origin,
                                                       const Vec3& normal, const Vec3& along,
                                                       const Edge& entry) const {
  const Face& corners = mesh_.faces[face];
  std::optional<Stop> best;
  double furthest = -HUGE_VAL;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t a = corners[k];
    const std::int32_t b = corners[(k + 1) % 3];
    if (a == entry.second && b == entry.first) continue;
    const double at_a = (mesh_.vertices[a] - origin).dot(normal);
    const double at_b = (mesh_.vertices[b] - origin).dot(normal);
    if ((at_a >= 0) == (at_b >= 0)) continue;  // a vertex on the plane counts as above it
    Stop stop{.a = a, .b = b, .weight = at_a / (at_a - at_b), .face = face, .position = {}};
    stop.position = (1 - stop.weight) * mesh_.vertices[a] + stop.weight * mesh_.vertices[b];
    const double way = stop.position.dot(along);
    if (way > furthest) {
      furthest = way;
      best = stop;
    }
  }
  return best;
}

std::optional<std::vector<CarvedSurface::Stop>> CarvedSurface::follow(
    const SurfaceCurve& curve) const {
  const TriangleTree tree(mesh_);
  std::vector<Vec3> points;
  std::vector<std::int32_t> faces;
  for (const Vec3& point : curve.points) {
    const TreeTriangle& nearest = tree.triangles()[tree.nearest(point).triangle];
    points.push_back(closest_point(nearest, point));
    faces.push_back(nearest.face);
  }
  std::vector<Stop> stops;
  std::int32_t face = faces.front();
  if (!curve.closed) stops.push_back({.face = face, .position = points.front()});
  const std::size_t segments = points.size() - (curve.closed ? 0 : 1);
  for (std::size_t i = 0; i < segments; ++i) {
    const std::size_t j = (i + 1) % points.size();
    const Vec3 along = points[j] - points[i];
    const Vec3 normal = along.cross(curve.walls[i] + curve.walls[j]);
    if (!(normal.norm() > 1e-6 * along.norm())) {
      if (along.norm() > 0) return {};
      continue;
    }
    Edge entry{-1, -1};
    double progress = -HUGE_VAL;
    for (int step = 0; face != faces[j]; ++step) {
      std::optional<Stop> stop = exit(face, points[i], normal, along, entry);
      if (!stop || step > 60) return {};
      const double way = (stop->position - points[i]).dot(along);
      if (way < progress - along.squaredNorm()) return {};  // running away
      progress = std::max(progress, way);
      entry = {stop->a, stop->b};
      face = face_left_of(stop->b, stop->a);
      // Out through an edge and back through it: the curve only touches the triangle beyond.
      if (!stops.empty() && stops.back().a == stop->b && stops.back().b == stop->a) {
        stops.pop_back();
      } else {
        stops.push_back(*stop);
      }
    }
  }
  if (curve.closed) {
    while (stops.size() > 2 && stops.front().a == stops.back().b &&
           stops.front().b == stops.back().a) {
      stops.erase(stops.begin());
      stops.pop_back();
    }
  } else {
    stops.push_back({.face = face, .position = points.back()});
  }
  return stops;
}

std::int32_t CarvedSurface::split_edge(std::int32_t a, std::int32_t b, const Vec3& position) {
  const auto x = static_cast<std::int32_t>(mesh_.vertices.size());
  mesh_.vertices.push_back(position);
  some_face_.push_back(-1);
  on_path_.push_back(false);
  const std::array<std::int32_t, 2> sides{face_left_of(a, b), face_left_of(b, a)};
  for (const std::int32_t side : sides) {
    const Face old = mesh_.faces[side];
    const int k = old[0] != a && old[0] != b ? 0 : old[1] != a && old[1] != b ? 1 : 2;
    const std::int32_t c = old[k];
    const std::int32_t from = old[(k + 1) % 3];
    const std::int32_t to = old[(k + 2) % 3];
    face_of_.erase({from, to});
    const auto fresh = static_cast<std::int32_t>(mesh_.faces.size());
    mesh_.faces.emplace_back();
    source_.push_back(source_[side]);
    set_face(side, {c, from, x});
    set_face(fresh, {c, x, to});
  }
  for (Path& path : paths_) {
    std::vector<std::int32_t>& v = path.vertices;
    for (std::size_t i = 0; i + (path.closed ? 0 : 1) < v.size(); ++i) {
      const std::int32_t next = v[(i + 1) % v.size()];
      if (std::minmax(v[i], next) != std::minmax(a, b)) continue;
      v.insert(v.begin() + static_cast<std::ptrdiff_t>(i) + 1, x);
      on_path_[x] = true;
      break;
    }
  }
  return x;
}

std::int32_t CarvedSurface::split_face(std::int32_t face, const Vec3& position) {
  const auto x = static_cast<std::int32_t>(mesh_.vertices.size());
  mesh_.vertices.push_back(position);
  some_face_.push_back(-1);
  on_path_.push_back(false);
  const Face old = mesh_.faces[face];
  const auto fresh = static_cast<std::int32_t>(mesh_.faces.size());
  mesh_.faces.resize(mesh_.faces.size() + 2);
  source_.resize(mesh_.faces.size(), source_[face]);
  set_face(face, {old[0], old[1], x});
  set_face(fresh, {old[1], old[2], x});
  set_face(fresh + 1, {old[2], old[0], x});
  return x;
}

std::vector<std::int32_t> CarvedSurface::faces_at(const Stop& stop) const {
  if (stop.a < 0) return {stop.face};
  if (stop.a == stop.b) return faces_around(stop.a);
  return {face_left_of(stop.a, stop.b), face_left_of(stop.b, stop.a)};
}

bool CarvedSurface::share_face(const Stop& one, const Stop& other) const {
  const std::vector<std::int32_t> faces = faces_at(other);
  return std::ranges::any_of(faces_at(one), [&](std::int32_t face) {
    return std::ranges::find(faces, face) != faces.end();
  });
}

std::int32_t CarvedSurface::place(const Stop& stop) {
  if (stop.a >= 0 && stop.a == stop.b) {
    if (may_move(stop.a, stop.position)) mesh_.vertices[stop.a] = stop.position;
    return stop.a;
  }
  return stop.a >= 0 ? split_edge(stop.a, stop.b, stop.position)
                     : split_face(stop.face, stop.position);
}

std::optional<std::size_t> CarvedSurface::carve(const SurfaceCurve& curve) {
  std::optional<std::vector<Stop>> stops = follow(curve);
  if (!stops || stops->size() < 3) return {};
  std::vector<Stop> kept;
  for (Stop& stop : *stops) {
    if (stop.a < 0) {
      // An end within a face: a vertex of its own only well inside the face, else on the nearest
      // side.
      const Face& f = mesh_.faces[stop.face];
      const Vec3 normal = area_vector2(mesh_, stop.face);
      std::array<double, 3> part{};
      for (int k = 0; k < 3; ++k) {
        const Vec3& from = mesh_.vertices[f[(k + 1) % 3]];
        part[k] = (mesh_.vertices[f[(k + 2) % 3]] - from).cross(stop.position - from).dot(normal) /
                  normal.squaredNorm();
      }
      const auto k = static_cast<int>(std::ranges::min_element(part) - part.begin());
      if (part[k] < 0.2) {
        stop.a = f[(k + 1) % 3];
        stop.b = f[(k + 2) % 3];
        const double sum = part[(k + 1) % 3] + part[(k + 2) % 3];
        stop.weight = sum > 0 ? std::clamp(part[(k + 2) % 3] / sum, 0.0, 1.0) : 0;
        stop.position =
            (1 - stop.weight) * mesh_.vertices[stop.a] + stop.weight * mesh_.vertices[stop.b];
      }
    }
    if (stop.a >= 0 && stop.weight < kSnap) stop.b = stop.a;
    if (stop.a >= 0 && stop.weight > 1 - kSnap) stop.a = stop.b;
    const auto same = [&](const Stop& other) {
      return stop.a >= 0 && std::minmax(other.a, other.b) == std::minmax(stop.a, stop.b);
    };
    if (!kept.empty() && same(kept.back())) continue;
    // Back to a vertex that was passed: the stops between are a spike.
    const auto before = std::ranges::find_if(
        kept, [&](const Stop& other) { return stop.a == stop.b && stop.a >= 0 && same(other); });
    if (before != kept.end()) {
      if (before == kept.begin() && curve.closed) continue;
      kept.erase(before + 1, kept.end());
      continue;
    }
    kept.push_back(stop);
  }
  // Three stops of one face would make a flat triangle of it: the middle one is left out.
  for (std::size_t i = 1; i + 1 < kept.size();) {
    if (share_face(kept[i - 1], kept[i + 1])) {
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
      i = std::max<std::size_t>(i, 2) - 1;
    } else {
      ++i;
    }
  }
  if (kept.size() < 3) return {};
  // Ends within faces first: a face whose side is split is no longer the face that was found.
  if (kept.front().a < 0 && kept.back().a < 0 && kept.front().face == kept.back().face) return {};
  Path path{.vertices = std::vector<std::int32_t>(kept.size(), -1), .closed = curve.closed};
  for (const bool within : {true, false}) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if ((kept[i].a < 0) == within) path.vertices[i] = place(kept[i]);
    }
  }
  for (std::size_t i = 0; i + (curve.closed ? 0 : 1) < kept.size(); ++i) {
    const std::int32_t next = path.vertices[(i + 1) % kept.size()];
    if (!face_of_.contains({path.vertices[i], next})) return {};
  }
  for (const std::int32_t v : path.vertices) on_path_[v] = true;
  paths_.push_back(std::move(path));
  return paths_.size() - 1;
}

}  // namespace fracbench::bem
