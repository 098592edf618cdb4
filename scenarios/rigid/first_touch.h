#pragma once

#include <optional>

#include "core/impact.h"
#include "scenarios/rigid/mass_frame.h"
#include "scenarios/rigid/surface_tree.h"

namespace fracbench {

/// A solid in free flight.
struct FlyingSolid {
  const SurfaceTree* surface = nullptr;
  const MassFrame* frame = nullptr;
  double reach = 0;  ///< largest distance of its surface from its centre of mass, m
  BodyState state;
};

/// A ball in free flight.
struct FlyingBall {
  Vec3 center;
  Vec3 velocity;
  double radius = 0;
};

/// When the ball first touches the solid, within `seconds`; nothing where it does not, or where the
/// two touch already. Conservative advancement: time goes on by the gap over the largest speed at
/// which it can close (Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996), to
/// a gap of less than kTouch.
std::optional<double> first_touch(const FlyingBall& ball, const FlyingSolid& solid, double seconds);

/// The same for two balls, in closed form.
std::optional<double> first_touch(const FlyingBall& a, const FlyingBall& b, double seconds);

}  // namespace fracbench
