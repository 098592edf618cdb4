#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/impact.h"
#include "core/material.h"
#include "scenarios/scenario.h"

namespace fracbench {

/// The thresholds of the test `authors`; either suffices.
inline constexpr double kBreakingImpulse = 1e5;  ///< N s
inline constexpr double kBreakingForce = 1e7;    ///< N

/// What equation (2) needs to know of a contact besides the impulse and the striker.
struct ContactSpeed {
  double approach_speed = 0;  ///< along the surface's normal, before the step, m / s
  double effective_mass = 0;  ///< 1 / (1 / m_a + 1 / m_b), kg
};

/// The values of all three break tests for the impulses J_i d_i of one time step dt.
///
/// total impulse            sum of J_i
/// balanced contact force   (sum of |F_i| + |sum of F_i|) / 2, with F_i = J_i d_i / dt: half of the
///     sum of the magnitudes of all loads once the body's inertia balances the contact forces. One
///     blow on a free body gives J / dt; two equal blows against each other, which inertia need not
///     balance, give the force of one of them as well.
/// equation (2) stress      I (-d . n) / (A dt) of the strongest impulse, n the outward normal of
/// the
///     hit face; A is the area of the face, or pi a^2 of Hertz's largest contact patch (Johnson,
///     "Contact Mechanics", 11.1: ball of radius R on a body that is flat there,
///     a^2 = R delta, delta^(5/2) = 15 m v^2 / (16 E* sqrt R)).
BreakTestValues break_test_values(const std::vector<Impulse>& impulses,
                                  const std::vector<Striker>& strikers,
                                  const std::vector<ContactSpeed>& speeds, const Material& material,
                                  double time_step);

/// The impulse over the critical one, at which the same blow would just break a body of this
/// material: the values of `authors` and `eq2-face` grow in proportion to the impulse, that of
/// `eq2-patch` with its fifth root, since Hertz's patch grows with the power 4/5 of the speed.
double overload(BreakTest test, const BreakTestValues& values, const Material& material);

/// Whether a body of this material breaks.
bool breaks(BreakTest test, const BreakTestValues& values, const Material& material);

/// "authors", "eq2-face", "eq2-patch".
std::string_view name_of(BreakTest test);
const std::vector<std::string>& break_test_names();
/// Throws InputError, naming the nearest one; `where` says whose value it is.
BreakTest break_test_from(std::string_view name, std::string_view where);

}  // namespace fracbench
