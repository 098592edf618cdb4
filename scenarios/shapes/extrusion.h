#pragma once

#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// A closed outline, counter-clockwise around material, clockwise around a hole.
using Outline = std::vector<Eigen::Vector2d>;

/// The plane region that the outlines bound, in x and z, thick along y from -depth / 2 to
/// depth / 2, in triangles of about `spacing` and no angle below about 20 degrees (Delaunay
/// refinement, as far as the outline itself allows).
TriangleMesh extrusion(const std::vector<Outline>& outlines, double depth, double spacing);

}  // namespace fracbench
