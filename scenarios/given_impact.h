#pragma once

#include <span>

#include "core/impact.h"
#include "core/target.h"
#include "scenarios/scenario.h"

namespace fracbench {

/// An impact of several impulses that are given directly instead of by a collision, each as for
/// impact_at. Throws InputError also where there is none.
Impact impact_of(const Target& target, std::span<const GivenImpulse> impulses,
                 BreakTest test = BreakTest::authors);

/// An impact that is given directly instead of by a collision: an impulse of `magnitude` (N s)
/// along `direction` at `point`, which is moved to the nearest point of the target's surface. The
/// striker is the paper's ball at the speed at which a head-on blow gives this impulse; `test` says
/// how far above the critical impulse it is. Throws
/// InputError where the point is farther from the surface than 2 % of the longest side (naming the
/// distance), the direction is zero, the impulse is not positive, or any of them is not finite.
Impact impact_at(const Target& target, const Vec3& point, const Vec3& direction, double magnitude,
                 BreakTest test = BreakTest::authors);

}  // namespace fracbench
