#pragma once

#include <array>
#include <stdexcept>

#include "core/vec3.h"

namespace fracbench::cvd {

/// Four points that decide a side lie so nearly in a special position that 100 bits cannot tell:
/// the caller moves the sites by a hair and starts again.
class Degenerate : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A double with a bound of its error.
struct Bounded {
  double value = 0;
  double error = 0;

  /// +1 or -1 where the bound leaves no doubt, else 0.
  int sign() const;
};

using Corners = std::array<Vec3, 3>;

/// h_ij(x) = |x - p_i|^2 - |x - p_j|^2: negative on the side of site i. Linear in x, so on a
/// triangle it is given by its values at the corners; every decision below is the sign of a
/// determinant of such values.
Bounded bisector_value(const Vec3& p_i, const Vec3& p_j, const Vec3& x);

/// The bisector of sites i (the cell being cut) and j over the corners of a triangle.
struct Bisector {
  int site = -1;  ///< j
  std::array<Bounded, 3> at;
};

/// All that the three side decisions need. All of them return -1 on the side of site i and +1 on
/// the side of site j, decided in double precision where its error bound allows it, else with 106
/// bits; they throw Degenerate where that does not suffice either.
struct CellAndTriangle {
  const Corners& corners;
  const Vec3& site;  ///< p_i
};

/// Side of a corner.
int side_of_corner(const CellAndTriangle& where, int corner, const Bisector& j, const Vec3& p_j);

/// Side of the point where the bisector (i, k) crosses the edge from corner `edge` to the next.
int side_on_edge(const CellAndTriangle& where, int edge, const Bisector& k, const Vec3& p_k,
                 const Bisector& j, const Vec3& p_j);

/// Side of the point of the triangle's plane that is equally far from i, k and l.
int side_inside(const CellAndTriangle& where, const Bisector& k, const Vec3& p_k, const Bisector& l,
                const Vec3& p_l, const Bisector& j, const Vec3& p_j);

/// Sign of ((p_j - p_i) x (p_k - p_i)) . ((b - a) x (c - a)).
int axis_side(const Vec3& p_i, const Vec3& p_j, const Vec3& p_k, const Corners& triangle);

/// Sign of det(p_j - p_i, p_k - p_i, p_l - p_i).
int orientation(const Vec3& p_i, const Vec3& p_j, const Vec3& p_k, const Vec3& p_l);

/// +1 where m lies outside the sphere through i, j, k and l, -1 inside.
int side_of_sphere(const Vec3& p_i, const Vec3& p_j, const Vec3& p_k, const Vec3& p_l,
                   const Vec3& p_m);

/// Points that the cut creates, correct to about one unit in the last place.
Vec3 point_on_edge(const Vec3& a, const Vec3& b, const Vec3& p_i, const Vec3& p_j);
Vec3 point_in_triangle(const Corners& triangle, const Vec3& p_i, const Vec3& p_j, const Vec3& p_k);
Vec3 voronoi_vertex(const Vec3& p_i, const Vec3& p_j, const Vec3& p_k, const Vec3& p_l);

/// Sign of the turn a -> b -> c in the plane of coordinates u and v; 0 where it is straight.
int turn(const Vec3& a, const Vec3& b, const Vec3& c, int u, int v);

}  // namespace fracbench::cvd
