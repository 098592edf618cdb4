#include "methods/bem/front_stops.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fracbench::bem {
namespace {

// All in voxels.
constexpr double kMarch = 0.5;            // step of the search for the surface
constexpr double kSurfaceOvershoot = 2;   // least way beyond the last point inside
constexpr double kCrackOvershoot = 0.5;   // least way beyond the other crack
constexpr double kFarthestOvershoot = 6;  // until there is no body beside the plane
constexpr double kBeside = 0.9;           // how far beside: a sample of a voxel, about

}  // namespace

Vec3 beyond_surface(const Vec3& exit, const FrontMarker& marker, const Vec3& direction,
                    const CutLinks& links) {
  constexpr int kDirections = 8;
  const double voxel = links.spacing();
  const Vec3 across = direction.cross(marker.normal);
  Vec3 away = Vec3::Zero();
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2 * std::numbers::pi * k / kDirections;
    const Vec3 way = std::cos(angle) * direction + std::sin(angle) * across;
    if (links.inside(exit + kSurfaceOvershoot * voxel * way)) away -= way;
  }
  Vec3 out = direction;
  if (away.norm() > 0.1) out += away.normalized();
  if (out.norm() < 0.1) out = away;
  out.normalize();
  const auto at = [&](double over) -> Vec3 { return exit + over * voxel * out; };
  const auto clear = [&](double over) {
    return !links.inside(at(over)) && !links.inside(at(over) + kBeside * voxel * marker.normal) &&
           !links.inside(at(over) - kBeside * voxel * marker.normal);
  };
  for (double over = 0; over <= kFarthestOvershoot; over += kMarch) {
    if (!clear(over)) continue;
    const double end = std::max(over + 1, kSurfaceOvershoot);
    if (!links.inside(at(end))) return at(end);
  }
  // A narrow gap: as far as there is none of the body on its other side.
  Vec3 end = exit;
  for (double over = kMarch; over <= kSurfaceOvershoot; over += kMarch) {
    if (!links.inside(at(over))) end = at(over);
  }
  return end;
}

std::optional<FrontStop> stop_on_way(const FrontMarker& marker, const Vec3& direction,
                                     double length, bool forward, std::int32_t id,
                                     const CrackSpace& space) {
  const CutLinks& links = space.links;
  const double voxel = links.spacing();
  const int steps = std::max(1, static_cast<int>(std::ceil(length / (kMarch * voxel) - 1e-9)));
  const auto at = [&](double s) -> Vec3 { return marker.position + s * direction; };
  // Whether the point beside the plane at s has left the marker's side of the other crack as well.
  const auto past = [&](double s, const Vec3& beside) {
    return !links.inside(at(s) + beside) ||
           links.crack_between(marker.position, marker.position + beside, id) >= 0 ||
           links.crack_between(marker.position + beside, at(s) + beside, id) >= 0;
  };
  double before = 0;
  for (int k = 1; k <= steps; ++k) {
    const double here = length * k / steps;
    if (links.crack_between(at(before), at(here), id) >= 0) {
      const Vec3 beside = kBeside * voxel * marker.normal;
      for (double over = kCrackOvershoot; over <= kFarthestOvershoot; over += kMarch) {
        const double end = here + over * voxel;
        if (past(end, beside) && past(end, -beside)) {
          return FrontStop{at(end), FrontState::at_crack};
        }
      }
      return FrontStop{at(here + kCrackOvershoot * voxel), FrontState::at_crack};
    }
    if (!links.inside(at(here))) {
      return FrontStop{beyond_surface(at(here), marker, direction, links), FrontState::at_surface};
    }
    before = here;
  }
  const auto trace =
      space.traces.in_way(marker.position, direction, length, marker.normal, id, forward);
  if (!trace) return std::nullopt;
  // On along the other surface.
  const Vec3 along = direction - direction.dot(trace->normal) * trace->normal;
  return FrontStop{trace->position + voxel * along.normalized(), FrontState::at_crack};
}

}  // namespace fracbench::bem
