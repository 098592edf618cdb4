#pragma once

#include "core/material.h"
#include "core/vec3.h"
#include "methods/bem/crack_sheet.h"

namespace fracbench::bem {

/// K_eff = sqrt(K_I^2 + K_II^2 + K_III^2 / (1 - nu)), Pa sqrt(m): the stress intensity of the same
/// energy release rate in mode I. Faces that are pressed together (K_I < 0) do not drive the crack:
/// K_I counts as -K_I / compressive_factor, which is 0 for the default.
double effective_stress_intensity(const StressIntensity& k, double poisson_ratio,
                                  double compressive_factor = HUGE_VAL);

/// The stress that drives initiation and the `fast` stress intensity: `stress` itself, or, where
/// its compressive principal stress dominates (-s_3 / compressive_factor > s_1),
/// -stress / compressive_factor.
Mat3 driving_stress(const Mat3& stress, double compressive_factor);

/// Speed of Rayleigh waves, m/s: the root of the Rayleigh equation
/// (2 - c^2/c_s^2)^2 = 4 sqrt(1 - c^2/c_p^2) sqrt(1 - c^2/c_s^2).
double rayleigh_speed(const Material& material);

/// Speed of the front, m/s: c_R max(0.1, 1 - K_c^2 / K_eff^2), and 0 below K_c.
double crack_speed(double effective_stress_intensity, const Material& material);

/// The kink angle of maximum hoop stress, rad, positive towards the sheet's normal:
/// theta = 2 atan((K - sqrt(K^2 + 8 K_II^2)) / (4 K_II)) with K = sqrt(K_I^2 + K_III^2 / (1 - nu)),
/// K_I counted as 0 where negative (Erdogan and Sih 1963; with K_III as in Hahn and Wojtan 2015).
/// Between -70.53 and 70.53 degrees; 0 where K_II is 0.
double kink_angle(const StressIntensity& k, double poisson_ratio);

/// The direction in which the front advances: `forward` turned by `angle` towards the normal.
Vec3 kink_direction(const FrontFrame& frame, double angle);

}  // namespace fracbench::bem
