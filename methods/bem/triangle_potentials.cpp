#include "methods/bem/triangle_potentials.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fracbench::bem {
namespace {

// Line integrals along an edge, s being the length along it from the point nearest to x and R the
// distance to x.
struct EdgeIntegrals {
  double inverse = 0;       // of 1 / R
  double inverse_cube = 0;  // of 1 / R^3
  double first = 0;         // of s / R^3
  double second = 0;        // of s^2 / R^3
};

EdgeIntegrals edge_integrals(double begin, double end, double squared_distance) {
  const double r0 = std::sqrt(begin * begin + squared_distance);
  const double r1 = std::sqrt(end * end + squared_distance);
  EdgeIntegrals edge;
  edge.first = 1 / r0 - 1 / r1;
  if (begin * end > 0) {
    // Written so that nothing cancels where x is close to the edge's line.
    edge.inverse =
        begin > 0 ? std::log((r1 + end) / (r0 + begin)) : std::log((r0 - begin) / (r1 - end));
    edge.inverse_cube = (end * end - begin * begin) / (r0 * r1 * (end * r0 + begin * r1));
  } else {
    edge.inverse = std::log((r1 + end) * (r0 - begin) / squared_distance);
    edge.inverse_cube = (end / r1 - begin / r0) / squared_distance;
  }
  edge.second = edge.inverse - squared_distance * edge.inverse_cube;
  return edge;
}

}  // namespace

// With r = h n - p, p in the triangle's plane from the foot of x, each integral splits into moments
// of p over powers of |r|. The divergence theorem in the plane turns them into line integrals along
// the edges, e.g. 3 h^2 int 1/|r|^5 = int 1/|r|^3 + sum d int ds/|r|^3 with the edges' distances d
// from the foot, and into the solid angle h int 1/|r|^3 (Van Oosterom and Strackee 1983).
TrianglePotentials triangle_potentials(const Corners& corners, const Vec3& normal, const Vec3& x,
                                       const Vec3& density) {
  TrianglePotentials result;
  const Vec3 a = corners[0] - x;
  const Vec3 b = corners[1] - x;
  const Vec3 c = corners[2] - x;
  const double height = -(a + b + c).dot(normal) / 3;
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  // a . (b x c) is negative on the normal's side.
  result.solid_angle = 2 * std::atan2(-a.dot(b.cross(c)), denominator);

  const double in_normal = density.dot(normal);
  const Vec3 in_plane = density - in_normal * normal;
  const double tiny =
      std::max(std::numeric_limits<double>::min(), 1e-28 * (la * la + lb * lb + lc * lc));

  Vec3 first_moment = Vec3::Zero();     // int p / |r|^3
  Vec3 first_over_five = Vec3::Zero();  // int p / |r|^5
  double edge_sum = 0;                  // sum of d int ds / |r|^3
  Mat3 second_edges = Mat3::Zero();     // sum over the edges of int p nu^T / |r|^3
  Mat3 third_edges = Mat3::Zero();      // sum over the edges of int p (p . density) nu^T / |r|^3
  for (int k = 0; k < 3; ++k) {
    const Vec3 from = corners[k] - x;
    const Vec3 side = corners[(k + 1) % 3] - corners[k];
    const double length = side.norm();
    const Vec3 along = side / length;
    const Vec3 out = along.cross(normal);
    const double begin = from.dot(along);
    const double distance = from.dot(out);
    const EdgeIntegrals edge = edge_integrals(
        begin, begin + length, std::max(distance * distance + height * height, tiny));
    first_moment -= edge.inverse * out;
    first_over_five -= edge.inverse_cube / 3 * out;
    edge_sum += distance * edge.inverse_cube;
    const Vec3 moment = distance * edge.inverse_cube * out + edge.first * along;
    second_edges += moment * out.transpose();
    const double along_density = along.dot(density);
    const double out_density = out.dot(density);
    const Vec3 third = (distance * distance * edge.inverse_cube * out_density +
                        distance * edge.first * along_density) *
                           out +
                       (distance * edge.first * out_density + edge.second * along_density) * along;
    third_edges += third * out.transpose();
  }

  result.field = result.solid_angle * normal - first_moment;

  const double all_normal = (result.solid_angle + height * edge_sum) / 3;  // h^3 int 1 / |r|^5
  // height * int p p^T / |r|^5
  const Mat3 plane = Mat3::Identity() - normal * normal.transpose();
  const Mat3 second = (result.solid_angle * plane - height * second_edges) / 3;
  const Mat3 third =
      (first_moment.dot(in_plane) * plane + first_moment * in_plane.transpose() - third_edges) / 3;
  const Vec3 mixed = second * in_plane - height * height * in_normal * first_over_five;
  result.third = (all_normal * in_normal - height * height * first_over_five.dot(in_plane)) *
                     normal * normal.transpose() +
                 (normal * mixed.transpose() + mixed * normal.transpose()) + in_normal * second -
                 third;
  result.third = (result.third + result.third.transpose()).eval() / 2;
  return result;
}

}  // namespace fracbench::bem
