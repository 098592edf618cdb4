#pragma once

#include <span>
#include <vector>

#include "methods/bem/crack_sheet.h"

namespace fracbench::bem {

/// A flat disc of radius `radius` (m) around the origin, normal +z, as `rings` rings of triangles:
/// ring k has 6 k vertices, 6 rings^2 triangles in all. Ring k lies at radius a g(k / rings) with
/// g(s) = s + grading (sin(pi s / 2) - s): 0 evenly spaced, 1 finest at the front.
CrackSheet disc_crack(double radius, int rings, double grading = 0);

/// The boundary of a sheet with one boundary loop, in the order that CrackSheet wants, from the
/// boundary vertex with the lowest number. Throws InputError where there are none or several.
std::vector<std::int32_t> boundary_loop(const TriangleMesh& mesh);

/// The surface of the box spanned by the first and last of the given coordinates (m, ascending),
/// each side a grid of rectangles cut in two.
TriangleMesh grid_box(std::span<const double> xs, std::span<const double> ys,
                      std::span<const double> zs);

/// `low` to `high` in `count` steps that grow from `low` by the same factor, the last `ratio` times
/// as long as the first. Leaves out `low`.
std::vector<double> graded(double low, double high, int count, double ratio);

/// A cracked body for validation: a closed surface and a sheet whose mouth lies on its edges.
struct CrackedBody {
  TriangleMesh surface;
  CrackSheet crack;
};

/// A strip 0 < x < 1 (its width), |y| < half_height, |z| < thickness / 2 with an edge crack of
/// depth `depth` from x = 0 in the plane y = 0 through the whole thickness, normal +y. The grid
/// along x has `steps` steps on the crack, finest at mouth and front, `layers` along z.
struct StripShape {
  double depth = 0.1;
  double half_height = 1;
  double thickness = 0.1;
  int steps = 6;
  int layers = 3;
};
CrackedBody edge_cracked_strip(const StripShape& shape);

/// A block |x| < size, |y| < size, -size < z < 0 with a half-disc of radius 1 around the origin in
/// the plane y = 0 as surface crack, normal +y, in `rings` rings.
CrackedBody half_penny_block(double size, int rings);

}  // namespace fracbench::bem
