#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/context.h"
#include "core/material.h"
#include "methods/bem/cracked_surface.h"
#include "methods/bem/operator_cache.h"
#include "methods/bem/stress_field.h"

namespace fracbench::bem {

/// Openings of cracks: for each crack, the displacement of the upper side minus that of the lower
/// at every vertex of its sheet, m. Negative along the normal where the load presses the faces
/// together: contact is not imposed (a negative mode I does not drive a crack, see growth_law.h),
/// so that the system stays linear.
using Openings = std::vector<std::vector<Vec3>>;

/// Cracks in an infinite body under the far stress `stress` (Pa): the opening is 0 on the whole
/// boundary of every sheet. Throws MethodFailure where the system cannot be factored.
Openings openings_in_infinite_body(std::span<const CrackSheet> cracks, const Mat3& stress,
                                   const Material& material, const Context& context);

/// What cracks change in a loaded body.
struct CrackedSolution {
  /// m, at the vertices of CrackedSurface::surface, without those of the uncracked body.
  std::vector<Vec3> displacements;
  Openings openings;  ///< for CrackedSurface::sheets
  /// Components of openings held at 0, because the others determine them already (two sheets that
  /// lie on each other) or the integrals are too inexact for them (sheets that run through each
  /// other or the surface).
  std::size_t held = 0;
};

/// Solves cracked bodies that differ a little from call to call (cracks grow, mouths are carved):
/// one symmetric system for the displacements of the surface and the openings of all cracks,
/// Cholesky factored anew, its operator assembled where the geometry changed only. At the front the
/// opening is 0, at a mouth it is the difference of the two sides of the surface. It is also 0
/// where a sheet ran into another crack or overshoots the surface: the sheets are not cut to fit
/// there. The load is the stress of the body without cracks, whose tractions on the cracks' planes
/// are taken away: what loads the surface, and body forces, are in it.
class CrackSystem {
 public:
  /// `stress`: of the body without cracks. It must not change from call to call.
  CrackSystem(const Material& material, StressField stress)
      : material_(material), stress_(std::move(stress)), operator_(material) {}

  /// What net force and torque the cracks' faces exert on a part of the body that they separate is
  /// taken out with the least change of the load vector. Throws MethodFailure where the system
  /// cannot be factored.
  CrackedSolution solve(const CrackedSurface& body, const Context& context);

  /// Of the last system.
  std::size_t unknowns() const { return unknowns_; }
  /// Vertices whose rows the last call assembled.
  std::size_t assembled_vertices() const { return operator_.assembled_vertices(); }

 private:
  /// Traction (Pa) that the uncracked stress exerts on each triangle of a sheet: the mean over the
  /// middles of its sides. Known triangles are not evaluated again.
  Eigen::Matrix3Xd tractions(const BoundaryElements& sheet);

  Material material_;
  StressField stress_;
  std::map<std::array<double, 9>, Vec3> known_tractions_;
  OperatorCache operator_;
  std::size_t unknowns_ = 0;
};

}  // namespace fracbench::bem
