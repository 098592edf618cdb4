#pragma once

#include <vector>

#include "core/fragments.h"
#include "core/triangle_mesh.h"

namespace fracbench {

/// Lengths are shares of the longest side of the body's bounding box.
struct TagOptions {
  double surface_tolerance = 1e-5;  ///< the original surface may be this far off; coordinates that
                                    ///< were written with six digits are within it
  double normal_agreement = 0.9;    ///< least dot product of the unit normals
  double interface_reach = 0.02;    ///< farthest that the other side of a crack may be
  int threads = 1;
};

/// Finds out where the faces of fragments come from that some tool made of `body`, from their
/// places alone. The fragments must be in the body's frame.
/// A face is original when its corners and its centroid lie within the tolerance of the body's
/// surface and its normal agrees with that of a body's face nearest to one of these four points
/// (faces thinner than the tolerance have no reliable normal and need no agreement); it is tagged
/// with that face. Any other face is fracture surface. It belongs to the crack between its fragment
/// and the one whose fracture surface is nearest to its centroid; the cracks are numbered by pairs
/// of fragments, in ascending order. Two fragments that meet in several places therefore have one
/// interface. A face with no other fragment within reach has none (-1).
Fragments tag_fragments(const TriangleMesh& body, std::vector<TriangleMesh> meshes,
                        const TagOptions& options = {});

}  // namespace fracbench
