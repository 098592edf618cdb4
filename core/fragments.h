#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// Where a face of a fragment comes from, over all the breaks of a scene.
struct FragmentFace {
  /// The face of the target's mesh that this face lies on; -1: it is fracture surface.
  std::int32_t original_face = -1;
  /// For fracture surface: the crack it belongs to. Both sides of a crack carry the same number, so
  /// faces that share it in two fragments are one interface.
  std::int32_t interface = -1;

  bool is_fracture() const { return original_face < 0; }
  bool operator==(const FragmentFace&) const = default;
};

/// A piece that is there at the end of the scene, in the frame of the target's mesh (as if it had
/// never moved).
struct Fragment {
  TriangleMesh mesh;
  std::vector<FragmentFace> faces;  ///< parallel to mesh.faces
  std::int32_t piece = -1;          ///< running number among all pieces that the scene ever made
  std::int32_t parent = -1;         ///< running number of the piece that it broke from; -1: target
  std::int32_t generation = 1;      ///< 1: a piece of the target, 2: a piece of a piece, ...
};

using Fragments = std::vector<Fragment>;

}  // namespace fracbench
