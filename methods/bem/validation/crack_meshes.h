#pragma once

#include "methods/bem/crack_sheet.h"

namespace fracbench::bem {

/// A flat disc of radius `radius` (m) around the origin, normal +z, as `rings` rings of triangles:
/// ring k has 6 k vertices, 6 rings^2 triangles in all. Ring k lies at radius a g(k / rings) with
/// g(s) = s + grading (sin(pi s / 2) - s): 0 evenly spaced, 1 finest at the front.
CrackSheet disc_crack(double radius, int rings, double grading = 0);

}  // namespace fracbench::bem
