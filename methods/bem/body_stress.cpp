#include "methods/bem/body_stress.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/parallel.h"
#include "methods/bem/surface_stress.h"

namespace fracbench::bem {
namespace {

// Stress is averaged over triangles around a corner whose normals differ by less than 30 degrees:
// across a sharp edge it jumps.
constexpr double kSmoothCosine = 0.8660254037844386;

std::vector<std::array<Mat3, 3>> corner_stress(const BoundaryElements& elements,
                                               const std::vector<Mat3>& stresses) {
  const std::vector<std::vector<std::int32_t>> around = triangles_around_vertices(elements);
  std::vector<std::array<Mat3, 3>> corners(elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k) {
    for (int a = 0; a < 3; ++a) {
      Mat3 sum = Mat3::Zero();
      double area = 0;
      for (const std::int32_t other : around[elements.triangles[k][a]]) {
        if (elements.normals[k].dot(elements.normals[other]) < kSmoothCosine) continue;
        sum += elements.areas[other] * stresses[other];
        area += elements.areas[other];
      }
      corners[k][a] = sum / area;
    }
  }
  return corners;
}

}  // namespace

BodyStress::BodyStress(const ElasticBody& body, const BalancedLoad& load, const Context& context)
    : BodyStress(body.elements(), body.displacements(load.tractions, context), load,
                 body.material()) {}

BodyStress::BodyStress(const BoundaryElements& elements, const Eigen::VectorXd& displacements,
                       const BalancedLoad& load, const Material& material)
    : material_(material),
      elements_(elements),
      inertia_(load.inertia),
      displacements_(displacements),
      surface_(surface_stress(elements, displacements, load.tractions, material)),
      inside_(elements, displacements, load.tractions, material),
      tree_({elements.vertices, elements.triangles}) {
  corners_ = corner_stress(elements, surface_);
  if (inertia_.is_zero()) return;
  for (std::size_t v = 0; v < elements.vertices.size(); ++v) {
    displacements_.segment<3>(3 * static_cast<Eigen::Index>(v)) +=
        inertia_.displacement(elements.vertices[v], material);
  }
  for (std::size_t k = 0; k < elements.size(); ++k) {
    surface_[k] += inertia_.stress(elements.centroids[k], material);
  }
}

Mat3 BodyStress::on_surface_at(std::size_t triangle, const Vec3& x) const {
  const Corners corners = elements_.corners(triangle);
  const Vec3& normal = elements_.normals[triangle];
  const double doubled = 2 * elements_.areas[triangle];
  Mat3 stress = Mat3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3& next = corners[(k + 1) % 3];
    const Vec3& last = corners[(k + 2) % 3];
    stress += (next - x).cross(last - x).dot(normal) / doubled * corners_[triangle][k];
  }
  return stress;
}

Mat3 BodyStress::at(const Vec3& x) const {
  const TriangleTree::Nearest nearest = tree_.nearest(x);
  const TreeTriangle& triangle = tree_.triangles()[nearest.triangle];
  const auto face = static_cast<std::size_t>(triangle.face);
  const double radii = std::sqrt(nearest.squared_distance) / elements_.radii[face];
  const double way = std::clamp((radii - kSurfaceRadii) / (kInsideRadii - kSurfaceRadii), 0.0, 1.0);
  double share = way * way * (3 - 2 * way);  // of Somigliana's stress
  Mat3 stress = Mat3::Zero();
  if (share > 0) {
    const SomiglianaStress::Value value = inside_.at(x);
    if (value.inside < 0.5) share = 0;
    stress = share * value.stress;
  }
  if (share < 1) stress += (1 - share) * on_surface_at(face, closest_point(triangle, x));
  if (!inertia_.is_zero()) stress += inertia_.stress(x, material_);
  return stress;
}

std::vector<Mat3> BodyStress::at(std::span<const Vec3> points, int threads) const {
  std::vector<Mat3> stresses(points.size());
  parallel_for(
      points.size(), threads, [&](std::size_t k) { stresses[k] = at(points[k]); }, 16);
  return stresses;
}

StressField stress_field(std::shared_ptr<const BodyStress> stress, int threads) {
  return [stress = std::move(stress), threads](std::span<const Vec3> points) {
    return stress->at(points, threads);
  };
}

}  // namespace fracbench::bem
