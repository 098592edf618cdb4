#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/impact.h"
#include "core/material.h"
#include "methods/bem/boundary_elements.h"
#include "methods/bem/hertz.h"

namespace fracbench::bem {

/// A contact as the elastic body feels it.
struct ContactPatch {
  Vec3 point;           ///< m
  Vec3 direction;       ///< unit, the way the body is pushed
  Vec3 normal;          ///< of the surface, outward unit vector
  double radius = 0;    ///< of the patch, m
  double force = 0;     ///< mean over the contact, N: impulse over duration
  double duration = 0;  ///< s
};

/// The collision of each impulse with its striker. The radius of curvature of the body is that of
/// its mean curvature within kCurvatureReach of its size; where it is hollow its curvature is taken
/// down to -0.9 of the striker's. The speed is the striker's along the direction of the impulse;
/// for a striker that does not approach it is impulse over mass. Throws InputError for a striker
/// without positive radius or modulus and for an impulse that is not positive and finite.
HertzContact hertz_contact(const BoundaryElements& elements, const Material& material,
                           const Impulse& impulse, const Striker& striker);
constexpr double kCurvatureReach = 0.05;

/// Patches of all impulses of an impact.
std::vector<ContactPatch> contact_patches(const BoundaryElements& elements,
                                          const Material& material, const Impact& impact);

/// Tractions (Pa, 3 x triangles): each patch's force, spread evenly over the part of the surface
/// within its radius that faces its normal (less than 60 degrees from it), shared out by overlap
/// area; a patch that meets no such surface goes to the nearest triangle. Several patches add up.
/// The net force is that of the patches for any mesh.
Eigen::Matrix3Xd contact_tractions(const BoundaryElements& elements,
                                   std::span<const ContactPatch> patches);

/// The longest duration among the patches, s; 0 for none.
double load_duration(std::span<const ContactPatch> patches);

}  // namespace fracbench::bem
