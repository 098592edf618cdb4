#pragma once

#include <cstdint>

#include "core/context.h"
#include "core/triangle_mesh.h"
#include "methods/modes/tet_mesh.h"

namespace fracbench::modes {

enum class CageKind : std::uint8_t {
  automatic,  ///< the shape itself where it has at most `target_faces` faces, else an offset cage
  shape,      ///< the shape itself
  offset,     ///< a coarse surface around the shape
};

struct CageOptions {
  CageKind kind = CageKind::automatic;
  std::int64_t target_faces = 6000;  ///< of an offset cage, met within 10 %
  /// About as many tets (within 5 %), where the quality bound does not need more; 0: as few as it
  /// allows.
  std::int64_t target_tets = 0;
  double radius_edge_ratio = 2;  ///< bound of circumradius over shortest edge of every tet
  double minimum_dihedral = 5;   ///< bound of the dihedral angles, degrees
};

/// A setting of the comparison in the DeepFracture paper.
struct NamedCage {
  std::int64_t cage_faces = 0;
  int least_modes = 0, most_modes = 0;
};
inline constexpr NamedCage kPaperCage{6000, 5, 60};
inline constexpr NamedCage kPaperFineCage{13000, 10, 10};

/// A closed surface without self-intersections around `shape`, as many shells as it takes, in the
/// frame of the shape; or the shape itself, see CageKind. Every point of the shape lies inside an
/// offset cage, which is the surface at a small distance around the shape, remeshed: the distance
/// is a quarter of the cage's edge length where that does, and more where so coarse a surface would
/// cut into the shape. Throws InputError for options out of range or a shape that is no solid,
/// MethodFailure where no cage of that many faces is found (with the way out).
TriangleMesh build_cage(const TriangleMesh& shape, const CageOptions& options, Context& context);

/// Whether every point of the solid `shape` is inside the solid `cage`: their surfaces do not
/// touch, the shape's shells are inside the cage, and the cage's shells outside the shape.
bool encloses(const TriangleMesh& cage, const TriangleMesh& shape, int threads = 1);

/// The cage of a shape, tetrahedralised by TetGen, in the unit box of the shape.
/// Throws as build_cage, and MethodFailure with TetGen's reason and the way out.
TetMesh tetrahedralise_cage(const TriangleMesh& shape, const CageOptions& options,
                            Context& context);

}  // namespace fracbench::modes
