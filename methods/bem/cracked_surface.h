#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "methods/bem/crack_sheet.h"

namespace fracbench::bem {

/// A vertex of the sheet on the mouth. Its opening is no unknown of its own but the difference of
/// the surface's displacements on the two sides, `upper` minus `lower`.
struct MouthVertex {
  std::int32_t sheet = 0;   ///< index of the crack
  std::int32_t vertex = 0;  ///< of the crack's mesh
  std::int32_t upper = 0;   ///< of the surface
  std::int32_t lower = 0;   ///< of the surface; the same as `upper` where the mouth is closed
};

/// A body's surface, open along the mouths of its cracks, with the sheets that end there. The
/// displacement is continuous along the true boundary (surface and both faces of every crack), so
/// that the boundary elements conform.
struct CrackedSurface {
  TriangleMesh surface;  ///< the vertices along the mouths once for each side
  std::vector<CrackSheet> sheets;
  std::vector<MouthVertex> mouths;
  /// Cracks that reach the surface (two edges of their boundary or more) without a mouth in all
  /// places: there the sheet overshoots the surface, which stays continuous.
  std::int32_t overshooting = 0;
};

/// Doubles the vertices of `surface` along the mouths: the boundary edges of a sheet whose two ends
/// are also (bit for bit) the ends of an edge of the surface. The sheets must lie inside the closed
/// surface. A mouth vertex whose surface triangles still hang together (the tip of a mouth) is not
/// doubled: the opening is 0 there. Neither is one where mouths meet: a sheet has one opening at a
/// vertex, which cannot follow three or more separate parts of the surface, and displacements that
/// do not conform would make the system indefinite.
CrackedSurface split_mouths(const TriangleMesh& surface, std::span<const CrackSheet> sheets);

}  // namespace fracbench::bem
