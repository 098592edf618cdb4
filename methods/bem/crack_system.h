#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/context.h"
#include "core/material.h"
#include "methods/bem/cracked_surface.h"
#include "methods/bem/operator_cache.h"

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

/// A loaded body with cracks.
struct CrackedSolution {
  std::vector<Vec3> displacements;  ///< m, at the vertices of CrackedSurface::surface
  Openings openings;                ///< for CrackedSurface::sheets
};

/// Solves cracked bodies that differ a little from call to call (cracks grow, mouths are carved):
/// one symmetric system for the displacements of the surface and the openings of all cracks,
/// Cholesky factored anew, its operator assembled where the geometry changed only. At the front the
/// opening is 0, at a mouth it is the difference of the two sides of the surface.
class CrackSystem {
 public:
  explicit CrackSystem(const Material& material) : material_(material), operator_(material) {}

  /// `tractions` on the triangles of body.surface (Pa, 3 x triangles), on the crack's faces none.
  /// What net force and torque they have on each part of the body that the cracks separate is taken
  /// out with the least change of the load vector. Throws MethodFailure where the system cannot be
  /// factored.
  CrackedSolution solve(const CrackedSurface& body, const Eigen::Matrix3Xd& tractions,
                        const Context& context);

  /// Of the last system.
  std::size_t unknowns() const { return unknowns_; }
  /// Vertices whose rows the last call assembled.
  std::size_t assembled_vertices() const { return operator_.assembled_vertices(); }

 private:
  Material material_;
  OperatorCache operator_;
  std::size_t unknowns_ = 0;
};

}  // namespace fracbench::bem
