#include "methods/modes/interface_faces.h"

#include <limits>
#include <vector>

#include "core/random.h"

namespace fracbench::modes {
namespace {

/// A direction that points as far as can be to the front of all the unit normals: towards the
/// centre of the smallest ball around them (Badoiu and Clarkson, "Smaller core-sets for balls",
/// 2003).
Vec3 most_normal(std::span<const Vec3> normals) {
  Vec3 center = Vec3::Zero();
  for (const Vec3& n : normals) center += n / static_cast<double>(normals.size());
  for (int step = 1; step <= 200; ++step) {
    const Vec3* farthest = &normals[0];
    for (const Vec3& n : normals) {
      if ((n - center).squaredNorm() > (*farthest - center).squaredNorm()) farthest = &n;
    }
    center += (*farthest - center) / (step + 1);
  }
  return center.norm() > 1e-6 ? center.normalized() : normals[0];
}

/// Per vertex the direction away from the tets; zero for those inside.
std::vector<Vec3> outward_directions(const TetMesh& tets) {
  std::vector<std::vector<Vec3>> normals(tets.vertices.size());
  for (const auto& face : tets.boundary_faces) {
    const Vec3& a = tets.vertices[face.corners[0]];
    const Vec3 n =
        (tets.vertices[face.corners[1]] - a).cross(tets.vertices[face.corners[2]] - a).normalized();
    for (const std::int32_t v : face.corners) normals[v].push_back(n);
  }
  std::vector<Vec3> result(tets.vertices.size(), Vec3::Zero());
  for (std::size_t v = 0; v < result.size(); ++v) {
    if (!normals[v].empty()) result[v] = most_normal(normals[v]);
  }
  return result;
}

}  // namespace

partition::InterfaceComplex interface_faces(const TetMesh& tets,
                                            std::span<const std::int32_t> region_of_tet,
                                            double shift, std::uint64_t salt) {
  partition::InterfaceComplex complex;
  const std::vector<Vec3> outward = outward_directions(tets);
  std::vector<std::int32_t> number(tets.vertices.size(), -1);
  for (const auto& face : tets.interior_faces) {
    const std::int32_t below = region_of_tet[face.tets[0]], above = region_of_tet[face.tets[1]];
    if (below == above) continue;
    for (const std::int32_t v : face.corners) number[v] = 0;
    complex.mesh.faces.push_back(face.corners);
    complex.sides.push_back({1 + below, 1 + above});
  }
  Random random(salt);
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<std::int32_t>(complex.mesh.vertices.size());
    Vec3 move = outward[v];
    for (int axis = 0; axis < 3; ++axis) move[axis] += random.uniform(-0.1, 0.1);
    complex.mesh.vertices.push_back(tets.frame.to_body(tets.vertices[v] + shift * move));
  }
  for (Face& face : complex.mesh.faces) {
    for (std::int32_t& v : face) v = number[v];
  }
  return complex;
}

std::int32_t tet_at(const TetMesh& tets, const Vec3& point) {
  const Vec3 p = tets.frame.to_unit(point);
  std::int32_t best = -1;
  double best_weight = -std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < tets.tets.size(); ++t) {
    const auto& [a, b, c, d] = tets.tets[t];
    const Vec3& origin = tets.vertices[a];
    Mat3 edges;
    edges << tets.vertices[b] - origin, tets.vertices[c] - origin, tets.vertices[d] - origin;
    const Vec3 weights = edges.inverse() * (p - origin);
    const double least = std::min(weights.minCoeff(), 1 - weights.sum());
    if (least > best_weight) {
      best_weight = least;
      best = static_cast<std::int32_t>(t);
    }
  }
  return best;
}

}  // namespace fracbench::modes
