#pragma once

#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// An axis-aligned box.
struct Block {
  Vec3 low, high;
};

/// The surface of a union of blocks, as right-angled triangles whose legs are about `spacing` long:
/// every plane of a block cuts all the others, so that there are no T-junctions. Closed; manifold
/// where no two blocks touch in an edge or corner only.
TriangleMesh block_surface(const std::vector<Block>& blocks, double spacing);

}  // namespace fracbench
