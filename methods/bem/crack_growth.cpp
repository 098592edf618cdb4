#include "methods/bem/crack_growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/measures.h"
#include "methods/bem/front_loop.h"
#include "methods/bem/front_stops.h"

namespace fracbench::bem {
namespace {

constexpr int kFirstMarkers = 8;
constexpr double kFirstRadius = 1.4;  // spacings
constexpr double kReach = 3;          // voxels from the front's end to the surface beside it
constexpr double kSplit = 1.5;        // spacings
constexpr double kMerge = 0.5;        // spacings

/// Share of a triangle that lies in the body, from the centres of 64 equal parts where it crosses
/// the surface.
double share_inside(const Vec3& a, const Vec3& b, const Vec3& c, const CutLinks& links) {
  const int corners = links.inside(a) + links.inside(b) + links.inside(c);
  if (corners == 0 || corners == 3) return corners / 3;
  constexpr int kParts = 8;
  int count = 0;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; i + j < kParts; ++j) {
      // The upright part at (i, j), and the inverted one beside it where there is one.
      for (int k = 0; k < (i + j + 1 < kParts ? 2 : 1); ++k) {
        const double s = (i + (1 + k) / 3.0) / kParts, t = (j + (1 + k) / 3.0) / kParts;
        count += links.inside(a + s * (b - a) + t * (c - a));
      }
    }
  }
  return count / static_cast<double>(kParts * kParts);
}

/// The front during one substep, and the surface that it sweeps.
class Sweep {
 public:
  Sweep(Crack& crack, std::int32_t id, CrackSpace& space, const GrowthOptions& options)
      : crack_(crack), id_(id), space_(space), options_(options) {}

  void add_triangle(std::int32_t a, std::int32_t b, std::int32_t c);
  void merge_close_markers();
  void move(double duration);
  double area() const { return area_; }

 private:
  void add_vertex(FrontMarker& marker) {
    marker.vertex = static_cast<std::int32_t>(crack_.surface.vertices.size());
    crack_.surface.vertices.push_back(marker.position);
    if (space_.links.inside(marker.position)) {
      space_.traces.add({marker.position, marker.normal, id_});
    }
  }
  /// New markers between a and its successor b, in order.
  std::vector<FrontMarker> between(const FrontMarker& a, const FrontMarker& b) const;
  std::vector<FrontMarker> beside(const FrontMarker& end, const FrontMarker& stopped,
                                  bool stopped_is_next) const;
  void fill(std::int32_t from, std::int32_t to, std::span<const std::int32_t> chain);

  Crack& crack_;
  std::int32_t id_;
  CrackSpace& space_;
  const GrowthOptions& options_;
  double area_ = 0;
};

void Sweep::add_triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
  if (a == b || b == c || c == a) return;
  const auto& v = crack_.surface.vertices;
  crack_.surface.faces.push_back({a, b, c});
  space_.links.cut({v[a], v[b], v[c]}, id_);
  area_ +=
      0.5 * (v[b] - v[a]).cross(v[c] - v[a]).norm() * share_inside(v[a], v[b], v[c], space_.links);
}

/// Where the front converges, markers vanish; the surface between is filled.
void Sweep::merge_close_markers() {
  std::vector<FrontMarker>& front = crack_.front;
  for (std::size_t i = 0; i < front.size() && front.size() > 3;) {
    const std::size_t next = (i + 1) % front.size();
    const FrontMarker& a = front[i];
    const FrontMarker& b = front[next];
    const bool close = (a.position - b.position).norm() < kMerge * options_.spacing;
    const auto may_go = [](const FrontMarker& m) {
      return m.state == FrontState::advancing && m.coarse < 0;
    };
    if (!close || !(may_go(a) || may_go(b))) {
      ++i;
      continue;
    }
    const std::size_t gone = may_go(b) ? next : i;
    const std::size_t before = (gone + front.size() - 1) % front.size();
    const std::size_t after = (gone + 1) % front.size();
    add_triangle(front[after].vertex, front[gone].vertex, front[before].vertex);
    front.erase(front.begin() + static_cast<std::ptrdiff_t>(gone));
    if (gone < i) --i;
  }
}

/// At the end of an advancing run the front is drawn along the surface, or the crack, at which its
/// neighbour stopped; where that lies far off, the front spreads sideways.
std::vector<FrontMarker> Sweep::beside(const FrontMarker& end, const FrontMarker& stopped,
                                       bool stopped_is_next) const {
  const Vec3 apart = stopped.position - end.position;
  const double distance = apart.norm();
  // One that stopped ahead is reached by going on.
  if (distance < 1.2 * options_.spacing || apart.dot(end.forward) > 0.3 * distance) return {};
  const Vec3 on = end.normal.cross(end.forward);  // along the loop
  const Vec3 sideways = stopped_is_next ? on : Vec3(-on);
  FrontMarker marker = end;
  marker.coarse = -1;
  if (const auto stop =
          stop_on_way(end, sideways, kReach * space_.links.spacing(), false, id_, space_)) {
    if ((stop->position - stopped.position).norm() < options_.spacing) return {};
    marker.position = stop->position;
    marker.state = stop->state;
    return {marker};
  }
  if (distance < kSplit * options_.spacing) return {};
  marker.position = end.position + std::min(options_.spacing, 0.5 * distance) * sideways;
  marker.forward = (2 * end.forward + sideways).normalized();
  marker.normal = (end.normal - end.normal.dot(marker.forward) * marker.forward).normalized();
  return {marker};
}

std::vector<FrontMarker> Sweep::between(const FrontMarker& a, const FrontMarker& b) const {
  const bool a_advances = a.state == FrontState::advancing;
  const bool b_advances = b.state == FrontState::advancing;
  if (a_advances && !b_advances) return beside(a, b, true);
  if (b_advances && !a_advances) return beside(b, a, false);
  const double distance = (b.position - a.position).norm();
  if (!a_advances || distance <= kSplit * options_.spacing) return {};
  const int count = static_cast<int>(std::ceil(distance / options_.spacing)) - 1;
  std::vector<FrontMarker> markers(count, a);
  for (int k = 0; k < count; ++k) {
    const double t = (k + 1.0) / (count + 1);
    FrontMarker& m = markers[k];
    m.coarse = -1;
    m.position = (1 - t) * a.position + t * b.position;
    m.speed = (1 - t) * a.speed + t * b.speed;
    const Vec3 forward = (1 - t) * a.forward + t * b.forward;
    if (forward.norm() > 0.1) m.forward = forward.normalized();
    const Vec3 normal = (1 - t) * a.normal + t * b.normal;
    const Vec3 upright = normal - normal.dot(m.forward) * m.forward;
    if (upright.norm() > 0.1) m.normal = upright.normalized();
    if (!space_.links.inside(m.position)) {
      m.state = FrontState::at_surface;
      m.position = beyond_surface(m.position, m, m.forward, space_.links);
    }
  }
  return markers;
}

/// The surface between the front's old edge from -> to and its new way over `chain`.
void Sweep::fill(std::int32_t from, std::int32_t to, std::span<const std::int32_t> chain) {
  const auto& v = crack_.surface.vertices;
  std::size_t apex = 0;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const double length = (v[chain[k]] - v[from]).norm() + (v[chain[k]] - v[to]).norm();
    if (chain[k] == from || chain[k] == to || length >= best) continue;
    best = length;
    apex = k;
  }
  for (std::size_t k = 0; k < apex; ++k) add_triangle(from, chain[k], chain[k + 1]);
  add_triangle(to, from, chain[apex]);
  for (std::size_t k = apex; k + 1 < chain.size(); ++k) add_triangle(to, chain[k], chain[k + 1]);
}

void Sweep::move(double duration) {
  const std::vector<FrontMarker> old = crack_.front;
  std::vector<FrontMarker> moved = old;
  const std::size_t count = old.size();
  for (FrontMarker& m : moved) {
    const double length = m.speed * duration;
    if (m.state != FrontState::advancing || !(length > 0)) continue;
    if (const auto stop = stop_on_way(m, m.forward, length, true, id_, space_)) {
      m.position = stop->position;
      m.state = stop->state;
    } else {
      m.position += length * m.forward;
    }
  }
  // Neighbours that would pass each other meet in the middle.
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    FrontMarker& a = moved[i];
    FrontMarker& b = moved[next];
    if (a.state != FrontState::advancing || b.state != FrontState::advancing) continue;
    const Vec3 before = old[next].position - old[i].position;
    if ((b.position - a.position).dot(before) > 0.1 * before.squaredNorm()) continue;
    a.position = b.position = 0.5 * (a.position + b.position);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (moved[i].position != old[i].position) add_vertex(moved[i]);
  }
  std::vector<FrontMarker> front;
  front.reserve(count + count / 4);
  std::vector<std::int32_t> chain;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    std::vector<FrontMarker> inserted = between(moved[i], moved[next]);
    front.push_back(moved[i]);
    chain.assign(1, moved[i].vertex);
    for (FrontMarker& m : inserted) {
      add_vertex(m);
      chain.push_back(m.vertex);
      front.push_back(m);
    }
    chain.push_back(moved[next].vertex);
    if (chain.size() == 2 && chain[0] == old[i].vertex && chain[1] == old[next].vertex) continue;
    fill(old[i].vertex, old[next].vertex, chain);
  }
  crack_.front = std::move(front);
}

/// The disc's plane at the element: `inward` points from the surface into the body.
struct SeedPlane {
  Vec3 center;
  Vec3 inward, sideways;
};

SeedPlane seed_plane(const CrackSeed& seed, const Vec3& surface_normal, double depth) {
  SeedPlane plane;
  plane.center = seed.position - depth * surface_normal;
  Vec3 inward = -surface_normal + surface_normal.dot(seed.normal) * seed.normal;
  if (inward.norm() < 1e-3) inward = seed.normal.unitOrthogonal();
  plane.inward = inward.normalized();
  plane.sideways = seed.normal.cross(plane.inward);
  return plane;
}

}  // namespace

bool advances(const Crack& crack) {
  return std::any_of(crack.front.begin(), crack.front.end(),
                     [](const FrontMarker& m) { return m.state == FrontState::advancing; });
}

double advance(Crack& crack, std::int32_t id, double duration, CrackSpace& space,
               const GrowthOptions& options) {
  Sweep sweep(crack, id, space, options);
  sweep.merge_close_markers();
  sweep.move(duration);
  return sweep.area();
}

std::optional<SeededCrack> seed_crack(const CrackSeed& seed, std::int32_t id, CrackSpace& space,
                                      const GrowthOptions& options) {
  // The element's centre may lie just outside the voxels: look a little deeper.
  for (const double depth : {0.0, 1.0, 2.0, 3.0}) {
    const SeedPlane plane = seed_plane(seed, seed.surface_normal, depth * space.links.spacing());
    SeededCrack seeded;
    Crack& crack = seeded.crack;
    crack.surface.vertices.push_back(plane.center);
    bool any = false;
    for (int k = 0; k < kFirstMarkers; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.5) / kFirstMarkers;
      FrontMarker marker;
      marker.forward = std::cos(angle) * plane.inward + std::sin(angle) * plane.sideways;
      marker.normal = seed.normal;
      marker.speed = 1;
      marker.position = plane.center + kFirstRadius * options.spacing * marker.forward;
      if (!space.links.inside(marker.position)) {
        marker.state = FrontState::at_surface;
        marker.position = beyond_surface(marker.position, marker, marker.forward, space.links);
      }
      any = any || marker.state == FrontState::advancing;
      marker.vertex = k + 1;
      crack.surface.vertices.push_back(marker.position);
      crack.front.push_back(marker);
    }
    if (!any) continue;
    Sweep first(crack, id, space, options);
    for (int k = 0; k < kFirstMarkers; ++k) {
      first.add_triangle(0, k + 1, (k + 1) % kFirstMarkers + 1);
    }
    seeded.area = first.area();
    const double radius = 0.5 * options.mesh_size;
    double reached = kFirstRadius * options.spacing;
    while (reached < radius - 1e-9 * radius) {
      const double step = std::min(options.spacing, radius - reached);
      seeded.area += advance(crack, id, step, space, options);
      reached += step;
    }
    mesh_disc(crack, plane.center);
    return seeded;
  }
  return std::nullopt;
}

std::optional<Crack> inherit(const Crack& crack, std::int32_t id, CrackSpace& space,
                             const GrowthOptions&) {
  Crack part = crack;
  const TriangleMesh& surface = part.surface;
  bool touches = false;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    space.links.cut({surface.corner(f, 0), surface.corner(f, 1), surface.corner(f, 2)}, id);
    const Vec3 normal = area_vector2(surface, f).normalized();
    for (int k = 0; k < 3; ++k) {
      if (!space.links.inside(surface.corner(f, k))) continue;
      touches = true;
      space.traces.add({surface.corner(f, k), normal, id});
    }
  }
  if (!touches) return std::nullopt;
  for (FrontMarker& m : part.front) {
    if (m.state == FrontState::advancing && !space.links.inside(m.position)) {
      m.state = FrontState::at_surface;
    }
  }
  update_boundary(part);
  return part;
}

}  // namespace fracbench::bem
