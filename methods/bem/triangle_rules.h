#pragma once

#include <span>
#include <vector>

namespace fracbench::bem {

/// A point of a quadrature rule on a triangle: corner_0 + u (corner_1 - corner_0) + v (corner_2 -
/// corner_0). The weights of a rule sum to 1: the rule gives means.
struct TrianglePoint {
  double u = 0;
  double v = 0;
  double weight = 0;
};

/// Symmetric Gauss rules of Strang and Fix (3 points, degree 2) and Dunavant 1985 (6 points,
/// degree 4; 12 points, degree 6). Throws std::invalid_argument for another number of points.
std::span<const TrianglePoint> triangle_rule(int points);

/// A point of a rule on [0, 1].
struct LinePoint {
  double x = 0;
  double weight = 0;
};

/// Gauss-Legendre rule with `points` points on [0, 1], exact to degree 2 points - 1.
std::vector<LinePoint> gauss_legendre(int points);

}  // namespace fracbench::bem
