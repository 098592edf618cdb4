#pragma once

#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// What stands for a solid where it meets other solids (balls meet its true surface instead, see
/// sphere_contact.h): convex parts that lie within it by a small gap.
struct Collider {
  struct Part {
    std::vector<Vec3> vertices;  ///< of a convex polytope, in the frame of the mesh
    double margin = 0;  ///< the engine's rounding of the polytope, outwards; less than the inset, m
  };
  std::vector<Part> parts;
};

struct ColliderOptions {
  double gap = 0.004;       ///< how far the collider stays within the solid, m
  double tolerance = 0.04;  ///< depth of a concavity that may be filled, m
  int max_parts = 8;
};

/// The parts of a solid. One hull where the solid is convex within `tolerance`; else it is cut by
/// planes, and the hull of each part taken, until the parts are that convex or max_parts is
/// reached.
Collider make_collider(const TriangleMesh& mesh, const ColliderOptions& options = {});

/// The bounding box: enough for a solid that meets nothing but balls.
Collider box_collider(const TriangleMesh& mesh);

}  // namespace fracbench
