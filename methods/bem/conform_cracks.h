#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/bem/cracked_surface.h"

namespace fracbench::bem {

/// A body's surface and its cracks, made to fit each other.
struct ConformedCracks {
  CrackedSurface body;
  std::vector<std::int32_t> source_face;  ///< for each triangle of body.surface, that of the input
  /// For each sheet and entry of its boundary, the entry of the given sheet's boundary, or -1.
  std::vector<std::vector<std::int32_t>> source_boundary;
};

/// Makes the surface conform to the cracks that reach it: carves the mouth of each (the boundary
/// vertices `at_surface`, which may lie a little outside or inside) into `surface`, sews the sheet
/// to the carved line, and doubles the surface's vertices along it. A crack for which this fails,
/// or whose mouth is shorter than about two edges of the surface, is left as it is and counted in
/// body.overshooting. `surface` must be closed.
ConformedCracks conform_cracks(const TriangleMesh& surface, std::span<const CrackSheet> cracks);

}  // namespace fracbench::bem
