#pragma once

#include "core/vec3.h"

namespace fracbench {

/// Whether the line through (y, z) along x crosses the triangle (a, b, c): 0 where not, 1 where the
/// triangle's normal points towards greater x, -1 where it points towards smaller x.
///
/// Exact, and one answer on shared edges and vertices: the line is taken to be displaced by an
/// infinitesimal amount along y and a still smaller one along z (simulation of simplicity,
/// Edelsbrunner and Muecke, 1990). So the crossings of a closed surface always add up to 0, and
/// those beyond a point that is not on the surface add up to its winding number.
int line_crossing(const Vec3& a, const Vec3& b, const Vec3& c, double y, double z);

/// For a triangle that the line through `point` along x crosses: whether the point lies beyond the
/// crossing, at greater x. Exact.
bool is_beyond(const Vec3& a, const Vec3& b, const Vec3& c, int crossing, const Vec3& point);

}  // namespace fracbench
