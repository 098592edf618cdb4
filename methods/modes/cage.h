#pragma once

#include <cstdint>
#include <string_view>

#include "core/context.h"
#include "core/triangle_mesh.h"
#include "methods/modes/tet_mesh.h"

namespace fracbench::modes {

enum class CageKind : std::uint8_t {
  automatic,  ///< the shape itself where it has at most `target_faces` faces, else an offset cage
  shape,      ///< the shape itself
  offset,     ///< a simplified surface around the shape
};

struct CageOptions {
  CageKind kind = CageKind::automatic;
  std::int64_t target_faces = 6000;  ///< of the cage; an offset cage comes within about 2 %
  /// Tets are refined until none is larger than the volume of the solid divided by this; 0: as few
  /// tets as the quality bound allows.
  double least_tets = 0;
  double radius_edge_ratio = 2;  ///< bound of circumradius over shortest edge of every tet
  double minimum_dihedral = 5;   ///< bound of the dihedral angles, degrees
};

/// A closed surface without self-intersections around `shape`, as many shells as it takes, in the
/// frame of the shape; or the shape itself, see CageKind. Every vertex and face of the shape lies
/// inside an offset cage.
/// Throws InputError for options out of range, MethodFailure where no such cage of that many faces
/// can be found (with the number that can).
TriangleMesh build_cage(const TriangleMesh& shape, const CageOptions& options, Context& context);

/// The cage of a shape, tetrahedralised by TetGen, in the unit box of the shape.
/// Throws as build_cage, and MethodFailure with TetGen's reason and the way out.
TetMesh tetrahedralise_cage(const TriangleMesh& shape, const CageOptions& options,
                            Context& context);

}  // namespace fracbench::modes
