#pragma once

#include "core/impact.h"
#include "core/material.h"
#include "methods/bem/boundary_elements.h"

namespace fracbench::bem {

/// An elastic collision of two bodies at a point, as Hertz's theory sees it: the two together.
struct HertzContact {
  double mass = 0;     ///< m with 1/m = 1/m_1 + 1/m_2, effective masses at the contact, kg
  double modulus = 0;  ///< E* with 1/E* = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2, Pa
  double radius = 0;   ///< R with 1/R = 1/R_1 + 1/R_2, radii of curvature, m
  double speed = 0;    ///< v at which they approach along the normal, m/s
};

/// How long the bodies touch, s: 2.87 (m^2 / (E*^2 R v))^(1/5). K. L. Johnson, Contact Mechanics
/// (1985), equation 11.24.
double contact_duration(const HertzContact& contact);

/// Radius of the patch where they touch when pressed together the most, m: sqrt(R d) with
/// d = (15 m v^2 / (16 E* sqrt(R)))^(2/5).
double contact_radius(const HertzContact& contact);

/// The mass (kg) that a free body of this mass and inertia about its centre of mass (kg m^2) sets
/// against an impulse along the unit vector `direction` at `point`.
double effective_mass(double mass, const Mat3& inertia, const Vec3& centre, const Vec3& point,
                      const Vec3& direction);

/// Mean curvature (1/m; 1/R on a sphere, positive where the surface bulges out) of the surface
/// within `reach` of `point`, averaged over the triangles there that face `normal`: half the sum of
/// the sides' lengths times the angles between their triangles, over the area. 0 where no triangle
/// is in reach.
double mean_curvature(const BoundaryElements& elements, const Vec3& point, const Vec3& normal,
                      double reach);

/// Area (m^2) of the part of a triangle within `radius` of `centre`; exact.
double area_in_ball(const Corners& corners, const Vec3& centre, double radius);

}  // namespace fracbench::bem
