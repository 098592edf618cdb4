#pragma once

#include "core/material.h"
#include "core/vec3.h"
#include "methods/bem/hertz.h"

namespace fracbench::bem {

/// Kelvin's solution: a point force in an infinite body. Love, A Treatise on the Mathematical
/// Theory of Elasticity (1927), article 130.
struct KelvinSource {
  Vec3 point;  ///< m
  Vec3 force;  ///< N

  Vec3 displacement(const Vec3& x, const Material& material) const;  ///< m
  Mat3 stress(const Vec3& x, const Material& material) const;        ///< Pa
};

/// The hoop stress at the inner surface of a thick sphere of radii a < b under inner pressure p:
/// p (a^3 + b^3 / 2) / (b^3 - a^3). Lame 1852; Timoshenko and Goodier, article 136.
double thick_sphere_hoop_stress(double a, double b, double p);

/// Duration (s) of a Hertzian collision by integration of m d'' = -4/3 E* sqrt(R) d^(3/2).
double integrated_contact_duration(const HertzContact& contact);

}  // namespace fracbench::bem
