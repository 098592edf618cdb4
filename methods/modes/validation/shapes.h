#pragma once

#include "core/triangle_mesh.h"

// The shapes of the reference table and of the analytic cases, with as few faces as they need.
namespace fracbench::modes {

/// 4 x 1 x 1.
TriangleMesh plain_bar();
/// 4 x 1 x 1 with a notch of width 0.2 and depth 0.5 at x = 2.
TriangleMesh notched_bar();
/// Two legs 2 x 1 x 0.5; the re-entrant corner is at (1, 1).
TriangleMesh l_shape();
/// 2 x 2 x 0.3 with a hole of radius 0.3 (48 segments) at the origin.
TriangleMesh plate_with_hole();
/// Two unit cubes that a neck of section 0.3 x 1 and length 0.6 joins, x = 1 to 1.6.
TriangleMesh dumbbell();

}  // namespace fracbench::modes
