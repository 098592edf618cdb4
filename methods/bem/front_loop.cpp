#include "methods/bem/front_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "geometry/measures.h"

namespace fracbench::bem {
namespace {

constexpr int kSeedEdges = 8;  // of the first fan
constexpr int kFewestSeedEdges = 5;

/// A stretch of the front that advances: markers first, first + 1, ... (around the loop).
struct Run {
  std::size_t first = 0;
  std::size_t count = 0;
};

std::vector<Run> advancing_runs(const std::vector<FrontMarker>& front) {
  const std::size_t n = front.size();
  const auto advancing = [&](std::size_t i) { return front[i % n].state == FrontState::advancing; };
  std::size_t start = 0;
  while (start < n && advancing(start)) ++start;
  if (start == n) return {{0, n}};
  std::vector<Run> runs;
  for (std::size_t i = start; i < start + n; ++i) {
    if (!advancing(i)) continue;
    if (!advancing(i + n - 1)) runs.push_back({i % n, 0});
    ++runs.back().count;
  }
  return runs;
}

/// Triangulates the coarse boundary, vertices 1, 2, ... of the sheet, without the hub in vertex 0:
/// always the best-shaped corner that holds no other vertex is cut off (ear clipping).
void clip_ears(Crack& crack, const Vec3& normal) {
  TriangleMesh& mesh = crack.sheet.mesh;
  mesh.vertices.erase(mesh.vertices.begin());
  for (FrontMarker& m : crack.front) m.coarse -= m.coarse >= 0;
  mesh.faces.clear();
  std::vector<std::int32_t> rest(mesh.vertices.size());
  std::iota(rest.begin(), rest.end(), 0);
  const auto turn = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    const auto& v = mesh.vertices;
    return (v[b] - v[a]).cross(v[c] - v[a]).dot(normal);
  };
  while (rest.size() > 3) {
    const std::size_t n = rest.size();
    std::size_t best = 0;
    double best_quality = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < n; ++k) {
      const std::int32_t a = rest[(k + n - 1) % n], b = rest[k], c = rest[(k + 1) % n];
      const auto& v = mesh.vertices;
      double quality = turn(a, b, c) / ((v[a] - v[b]).squaredNorm() + (v[b] - v[c]).squaredNorm() +
                                        (v[c] - v[a]).squaredNorm());
      for (const std::int32_t other : rest) {
        if (other == a || other == b || other == c) continue;
        if (turn(a, b, other) > 0 && turn(b, c, other) > 0 && turn(c, a, other) > 0) quality -= 2;
      }
      if (quality <= best_quality) continue;
      best_quality = quality;
      best = k;
    }
    mesh.faces.push_back({rest[(best + n - 1) % n], rest[best], rest[(best + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  }
  mesh.faces.push_back({rest[0], rest[1], rest[2]});
}

/// Markers at equal angles around the centre, in order: where the outline goes back on itself, as
/// it may beyond the surface, some angles have none.
std::vector<std::size_t> markers_by_angle(const std::vector<FrontMarker>& front,
                                          const Vec3& center) {
  const std::size_t n = front.size();
  const Vec3 axis = front[0].normal.unitOrthogonal(), other_axis = front[0].normal.cross(axis);
  std::vector<std::size_t> chosen;
  for (int c = 0; c < kSeedEdges; ++c) {
    const double angle = 2 * std::numbers::pi * c / kSeedEdges;
    const Vec3 way = std::cos(angle) * axis + std::sin(angle) * other_axis;
    std::size_t nearest = 0;
    double best = -2;
    for (std::size_t k = 0; k < n; ++k) {
      const double cosine = (front[k].position - center).normalized().dot(way);
      if (cosine <= best) continue;
      best = cosine;
      nearest = k;
    }
    const auto after_first = [&](std::size_t k) { return (k + n - chosen[0]) % n; };
    if (chosen.empty() || after_first(nearest) > after_first(chosen.back())) {
      chosen.push_back(nearest);
    }
  }
  return chosen;
}

struct Directions {
  Vec3 forward, normal;
};

/// Directions of marker j of a run from the chord of the markers within `reach` on either side.
Directions directions_in(const std::vector<FrontMarker>& front, const Run& run, std::size_t j,
                         double reach) {
  const std::size_t n = front.size();
  const bool closed = run.count == n;
  const auto at = [&](std::size_t k) -> const FrontMarker& { return front[(run.first + k) % n]; };
  const FrontMarker& own = at(j);
  Vec3 normal = own.normal;
  const auto walk = [&](std::size_t step_back_or_on, std::size_t most) {
    double length = 0;
    std::size_t k = j;
    for (std::size_t taken = 0; taken < most && length < reach; ++taken) {
      const std::size_t next = (k + step_back_or_on) % n;
      length += (at(next).position - at(k).position).norm();
      k = next;
      normal += at(k).normal;
    }
    return k;
  };
  std::size_t low = walk(n - 1, closed ? n / 4 : j);
  std::size_t high = walk(1, closed ? n / 4 : run.count - 1 - j);
  if (run.count < 3) {
    low = n - 1;
    high = run.count;
  }
  const Vec3 way = at(high).position - at(low).position;
  const Vec3 upright = normal - normal.dot(way) / std::max(way.squaredNorm(), 1e-300) * way;
  if (way.norm() > 0 && upright.norm() > 0.1 * normal.norm()) {
    const Vec3 forward = way.cross(upright).normalized();
    if (forward.dot(own.forward) > 0.3) return {forward, upright.normalized()};
  }
  return {own.forward, own.normal};
}

}  // namespace

std::vector<std::size_t> coarse_markers(const Crack& crack) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < crack.front.size(); ++i) {
    if (crack.front[i].coarse >= 0) indices.push_back(i);
  }
  return indices;
}

void update_boundary(Crack& crack) {
  crack.sheet.boundary.clear();
  crack.sheet.states.clear();
  for (const FrontMarker& m : crack.front) {
    if (m.coarse < 0) continue;
    crack.sheet.boundary.push_back(m.coarse);
    crack.sheet.states.push_back(m.state);
  }
}

void mesh_disc(Crack& crack, const Vec3& center) {
  std::vector<FrontMarker>& front = crack.front;
  const std::size_t n = front.size();
  std::vector<std::size_t> chosen = markers_by_angle(front, center);
  if (static_cast<int>(chosen.size()) < kFewestSeedEdges) {
    chosen.clear();
    for (std::size_t c = 0; c < kSeedEdges; ++c) chosen.push_back(c * n / kSeedEdges);
  }
  TriangleMesh& mesh = crack.sheet.mesh;
  mesh.vertices.assign(1, Vec3::Zero());
  for (const std::size_t k : chosen) {
    front[k].coarse = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.push_back(front[k].position);
    mesh.vertices[0] += front[k].position;
  }
  const auto first = static_cast<std::ptrdiff_t>(chosen[0]);
  std::rotate(front.begin(), front.begin() + first, front.end());
  const Vec3 normal = front[0].normal;
  const auto ring = static_cast<std::int32_t>(mesh.vertices.size()) - 1;
  mesh.vertices[0] /= ring;
  for (std::int32_t c = 0; c < ring; ++c) mesh.faces.push_back({0, c + 1, (c + 1) % ring + 1});
  const auto upright = [&] {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      if (area_vector2(mesh, f).dot(normal) <= 0) return false;
    }
    return true;
  };
  if (!upright()) mesh.vertices[0] = center;
  if (!upright()) clip_ears(crack, normal);
  update_boundary(crack);
}

void steer(Crack& crack, std::span<const FrontMotion> motions, const GrowthOptions& options) {
  std::vector<FrontMarker>& front = crack.front;
  const std::size_t n = front.size();
  const std::vector<std::size_t> coarse = coarse_markers(crack);
  const std::size_t m = coarse.size();
  const auto advancing = [&](std::size_t c) {
    return front[coarse[c % m]].state == FrontState::advancing;
  };
  // Kink angles smoothed over the neighbours on the front.
  std::vector<FrontMotion> smooth(motions.begin(), motions.end());
  for (std::size_t c = 0; c < m; ++c) {
    if (!advancing(c)) continue;
    double sum = 2 * motions[c].angle, weight = 2;
    for (const std::size_t other : {(c + m - 1) % m, (c + 1) % m}) {
      if (!advancing(other)) continue;
      sum += motions[other].angle;
      weight += 1;
    }
    smooth[c].angle = sum / weight;
  }
  // Linear in arc length between the coarse vertices.
  std::vector<double> angle(n, 0);
  for (std::size_t c = 0; c < m; ++c) {
    const std::size_t next = (c + 1) % m;
    const FrontMotion& a = smooth[advancing(c) ? c : next];
    const FrontMotion& b = smooth[advancing(next) ? next : c];
    // Between two that do not advance the markers go on as before.
    if (!advancing(c) && !advancing(next)) continue;
    const std::size_t markers = (coarse[next] + n - coarse[c] - 1) % n + 1;
    std::vector<double> along(markers + 1, 0);
    for (std::size_t k = 0; k < markers; ++k) {
      along[k + 1] =
          along[k] +
          (front[(coarse[c] + k + 1) % n].position - front[(coarse[c] + k) % n].position).norm();
    }
    for (std::size_t k = 0; k < markers; ++k) {
      const double t = along[markers] > 0 ? along[k] / along[markers] : 0;
      const std::size_t i = (coarse[c] + k) % n;
      angle[i] = (1 - t) * a.angle + t * b.angle;
      front[i].speed = (1 - t) * a.speed + t * b.speed;
    }
  }
  const std::vector<FrontMarker> before = front;
  for (const Run& run : advancing_runs(before)) {
    for (std::size_t j = 0; j < run.count; ++j) {
      const std::size_t i = (run.first + j) % n;
      const Directions d = directions_in(before, run, j, 0.5 * options.mesh_size);
      if (angle[i] != 0) front[i].turn = angle[i];
      const double cosine = std::cos(angle[i]), sine = std::sin(angle[i]);
      front[i].forward = cosine * d.forward + sine * d.normal;
      front[i].normal = cosine * d.normal - sine * d.forward;
    }
  }
}

}  // namespace fracbench::bem
