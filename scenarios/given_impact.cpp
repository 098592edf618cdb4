#include "scenarios/given_impact.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "geometry/measures.h"
#include "scenarios/break_test.h"
#include "scenarios/rigid/surface_tree.h"
#include "scenarios/scenario.h"

namespace fracbench {

namespace {

constexpr double kFarthestShare = 0.02;

/// The point of the surface where the impulse acts.
SurfacePoint place_on(const SurfaceTree& surface, const Target& target, const GivenImpulse& impulse,
                      double size) {
  const auto& [point, direction, magnitude] = impulse;
  if (!point.allFinite() || !direction.allFinite() || !std::isfinite(magnitude)) {
    throw InputError("impact: point, direction and impulse must be finite numbers");
  }
  if (!(direction.norm() > 0)) {
    throw InputError("impact: the direction is 0,0,0; give the way the body is pushed");
  }
  if (!(magnitude > 0)) {
    throw InputError(fmt::format("impact: the impulse is {} N s, must be above 0", magnitude));
  }
  const SurfacePoint place = surface.nearest(point);
  if (place.distance > kFarthestShare * size) {
    throw InputError(fmt::format(
        "impact: the point {:.6g},{:.6g},{:.6g} is {:.4g} m away from the surface of '{}', allowed "
        "is {:.4g} m (2 % of its longest side); the nearest point of the surface is "
        "{:.6g},{:.6g},{:.6g}",
        point.x(), point.y(), point.z(), place.distance, target.name, kFarthestShare * size,
        place.point.x(), place.point.y(), place.point.z()));
  }
  return place;
}

}  // namespace

Impact impact_of(const Target& target, std::span<const GivenImpulse> impulses, BreakTest test) {
  if (impulses.empty()) throw InputError("impact: there is no impulse");
  const double size = bounding_box(target.mesh).longest_side();
  const SurfaceTree surface(target.mesh);
  const Ball ball;
  const double ball_mass =
      ball.material.density * 4 / 3 * std::numbers::pi * std::pow(ball.radius, 3);
  const double target_mass = target.material.density * volume(target.mesh);
  const double effective_mass = 1 / (1 / ball_mass + 1 / target_mass);
  Impact impact;
  impact.time_step = Scenario{}.time_step;
  std::vector<ContactSpeed> speeds;
  for (const GivenImpulse& given : impulses) {
    const SurfacePoint place = place_on(surface, target, given, size);
    const Vec3 area2 = area_vector2(target.mesh, place.face);
    const double speed = given.magnitude / (effective_mass * (1 + target.material.restitution));
    impact.impulses.push_back({.point = place.point,
                               .direction = given.direction.normalized(),
                               .magnitude = given.magnitude,
                               .face = place.face,
                               .normal = area2.normalized(),
                               .face_area = area2.norm() / 2});
    impact.strikers.push_back({.mass = ball_mass,
                               .radius = ball.radius,
                               .young_modulus = ball.material.young_modulus,
                               .poisson_ratio = ball.material.poisson_ratio,
                               .velocity = speed * given.direction.normalized()});
    speeds.push_back({.approach_speed = speed, .effective_mass = effective_mass});
  }
  impact.break_test = break_test_values(impact.impulses, impact.strikers, speeds, target.material,
                                        impact.time_step);
  impact.overload = overload(test, impact.break_test, target.material);
  return impact;
}

Impact impact_at(const Target& target, const Vec3& point, const Vec3& direction, double magnitude,
                 BreakTest test) {
  const GivenImpulse impulse{.point = point, .direction = direction, .magnitude = magnitude};
  return impact_of(target, {&impulse, 1}, test);
}

}  // namespace fracbench
