#include "methods/bem/touching_pairs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "methods/bem/triangle_rules.h"

namespace fracbench::bem {
namespace {

// Points in each direction, for triangles of ordinary shape and for slender ones (whose smallest
// height is below kSlender times the longest side).
constexpr int kEdgePoints = 10;
constexpr int kEdgePointsSlender = 24;
constexpr int kVertexPoints = 7;
constexpr int kVertexPointsSlender = 12;
constexpr double kSlender = 0.35;

double doubled_area(const Corners& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
}

bool slender(const Corners& corners) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    longest = std::max(longest, (corners[(k + 1) % 3] - corners[k]).squaredNorm());
  }
  return doubled_area(corners) < kSlender * longest;
}

// Adds weight * r r^T / |r|^3 and returns weight * n . r / |r|^3.
double add_direction(const Vec3& r, const Vec3& normal, double weight, PairIntegrals& sums) {
  const double squared = r.squaredNorm();
  const double factor = weight / (squared * std::sqrt(squared));
  sums.values[0] += factor * r.x() * r.x();
  sums.values[1] += factor * r.y() * r.y();
  sums.values[2] += factor * r.z() * r.z();
  sums.values[3] += factor * r.x() * r.y();
  sums.values[4] += factor * r.x() * r.z();
  sums.values[5] += factor * r.y() * r.z();
  return factor * normal.dot(r);
}

// With the shared side e from the origin, x = x1 e + x2 a and y = y1 e + y2 b, the kernels depend
// on (z, x2, y2) with z = x1 - y1 alone. The length of the range of y1 for a given (z, x2, y2) is
// 1 - m, where m = max(y2, x2 + z) + max(0, -z) is homogeneous of degree one. So the integral along
// the ray through a point with m = 1 is known in closed form, and the plane pieces of {m = 1}
// remain: two triangles and two squares.
struct EdgePoint {
  double z = 0;
  double x2 = 0;
  double y2 = 0;
  double weight = 0;
};

std::vector<EdgePoint> make_edge_points(int points) {
  const std::vector<LinePoint> line = gauss_legendre(points);
  std::vector<EdgePoint> rule;
  for (const LinePoint& s : line) {
    for (const LinePoint& t : line) {
      const double weight = s.weight * t.weight;
      const double u = s.x * (1 - t.x);  // (u, v) on the triangle u, v >= 0, u + v <= 1
      const double v = s.x * t.x;
      rule.push_back({u, v, 1, weight * s.x});       // z >= 0, y2 = 1
      rule.push_back({s.x, 1 - s.x, t.x, weight});   // z >= 0, x2 + z = 1
      rule.push_back({-s.x, t.x, 1 - s.x, weight});  // z < 0, y2 - z = 1
      rule.push_back({-u, 1, v, weight * s.x});      // z < 0, x2 = 1
    }
  }
  return rule;
}

struct VertexPoint {
  double across_test = 0;
  double across_trial = 0;
  double ratio = 0;
  double weight = 0;
};

std::vector<VertexPoint> make_vertex_points(int points) {
  const std::vector<LinePoint> line = gauss_legendre(points);
  std::vector<VertexPoint> rule;
  for (const LinePoint& s : line) {
    for (const LinePoint& t : line) {
      for (const LinePoint& ratio : line) {
        rule.push_back({s.x, t.x, ratio.x, s.weight * t.weight * ratio.weight * ratio.x});
      }
    }
  }
  return rule;
}

}  // namespace

// For a kernel k of degree -1 the double integral is area / 3 times the integral over all
// directions of k(direction) times the longest chord of the triangle in that direction, since the
// triangle and itself shifted by s overlap in area (1 - s / chord)^2. The longest chords start at
// the corners: in the directions between its two sides from a corner to the side opposite it, whose
// points are h n + s e with the height h, and the integral along that side is elementary.
PairIntegrals coincident_pair(const Corners& corners) {
  Mat3 sum = Mat3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 first = corners[(k + 1) % 3] - corners[k];
    const Vec3 second = corners[(k + 2) % 3] - corners[k];
    const Vec3 along = (second - first).normalized();
    const double begin = first.dot(along);
    const double end = second.dot(along);
    const Vec3 foot = first - begin * along;
    const double height = foot.norm();
    const double far = second.norm();
    const double near = first.norm();
    const double inverse_cubes = (end / far - begin / near) / (height * height);
    const double first_moment = 1 / near - 1 / far;
    const double logarithm = std::asinh(end / height) - std::asinh(begin / height);
    const double second_moment = logarithm - (end / far - begin / near);
    const Mat3 mixed = foot * along.transpose();
    sum += height *
           (inverse_cubes * foot * foot.transpose() + first_moment * (mixed + mixed.transpose()) +
            second_moment * along * along.transpose());
  }
  sum *= doubled_area(corners) / 3;
  PairIntegrals result;
  result.values = {sum(0, 0), sum(1, 1), sum(2, 2), sum(0, 1), sum(0, 2), sum(1, 2), 0, 0, 0};
  return result;
}

PairIntegrals edge_pair(const Corners& test, const Corners& trial, const Vec3& normal) {
  static const std::vector<EdgePoint> ordinary = make_edge_points(kEdgePoints);
  static const std::vector<EdgePoint> many = make_edge_points(kEdgePointsSlender);
  const std::vector<EdgePoint>& rule = slender(test) || slender(trial) ? many : ordinary;
  const Vec3 shared = test[1] - test[0];
  const Vec3 a = test[2] - test[0];
  const Vec3 b = trial[2] - trial[0];
  PairIntegrals sums;
  for (const EdgePoint& point : rule) {
    const Vec3 r = point.z * shared + point.x2 * a - point.y2 * b;
    const double layer = add_direction(r, normal, point.weight, sums);
    const double least = std::max(0.0, -point.z);  // of y1, on m = 1
    const double one = (1 + least) / 6;
    const double two = point.y2 / 6;
    sums.values[6] += (0.5 - one - two) * layer;
    sums.values[7] += one * layer;
    sums.values[8] += two * layer;
  }
  const double scale = doubled_area(test) * doubled_area(trial);
  for (int k = 0; k < kPairComponents; ++k) sums.values[k] *= scale / 6;
  for (int k = 6; k < 9; ++k) sums.values[k] *= scale;
  return sums;
}

// x = xi X and y = xi ratio Y with X and Y on the sides opposite the shared corner, and the other
// way round: the integral over xi is elementary.
PairIntegrals vertex_pair(const Corners& test, const Corners& trial, const Vec3& normal) {
  static const std::vector<VertexPoint> ordinary = make_vertex_points(kVertexPoints);
  static const std::vector<VertexPoint> many = make_vertex_points(kVertexPointsSlender);
  const std::vector<VertexPoint>& rule = slender(test) || slender(trial) ? many : ordinary;
  const Vec3 a = test[1] - test[0];
  const Vec3 a_side = test[2] - test[1];
  const Vec3 b = trial[1] - trial[0];
  const Vec3 b_side = trial[2] - trial[1];
  PairIntegrals sums;
  for (const VertexPoint& point : rule) {
    const Vec3 x = a + point.across_test * a_side;
    const Vec3 y = b + point.across_trial * b_side;
    for (const bool test_is_farther : {true, false}) {
      const Vec3 r = test_is_farther ? Vec3(x - point.ratio * y) : Vec3(point.ratio * x - y);
      const double layer = add_direction(r, normal, point.weight, sums);
      const double reach = (test_is_farther ? point.ratio : 1) / 3;
      sums.values[6] += (0.5 - reach) * layer;
      sums.values[7] += reach * (1 - point.across_trial) * layer;
      sums.values[8] += reach * point.across_trial * layer;
    }
  }
  const double scale = doubled_area(test) * doubled_area(trial);
  for (int k = 0; k < kPairComponents; ++k) sums.values[k] *= scale / 3;
  for (int k = 6; k < 9; ++k) sums.values[k] *= scale;
  return sums;
}

}  // namespace fracbench::bem
