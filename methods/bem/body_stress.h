#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "geometry/triangle_tree.h"
#include "methods/bem/elastic_body.h"
#include "methods/bem/load_balance.h"
#include "methods/bem/somigliana_stress.h"
#include "methods/bem/stress_field.h"

namespace fracbench::bem {

/// A body's answer to a load: stress on its surface and anywhere inside.
class BodyStress {
 public:
  /// How far below the surface the stress is that of the surface alone, and from where on it is
  /// Somigliana's alone, in radii of the nearest triangle; smooth between.
  static constexpr double kSurfaceRadii = 0.1;
  static constexpr double kInsideRadii = 0.5;

  /// Solves for the displacements. `body` must outlive this object only until the constructor
  /// returns.
  BodyStress(const ElasticBody& body, const BalancedLoad& load, const Context& context);
  /// With displacements that are known (m, three per vertex; without those of load.inertia).
  BodyStress(const BoundaryElements& elements, const Eigen::VectorXd& displacements,
             const BalancedLoad& load, const Material& material);

  /// Displacements at the vertices, m, three each, those of the inertial field included.
  const Eigen::VectorXd& displacements() const { return displacements_; }
  /// Stress on each triangle, Pa.
  const std::vector<Mat3>& on_surface() const { return surface_; }

  /// Stress at a point, Pa: inside by Somigliana's identity, near the surface (kSurfaceRadii) and
  /// outside that of the nearest point of the surface, where it is the mean over the triangles
  /// around each corner that lie within 30 degrees of the nearest triangle, linear between corners.
  Mat3 at(const Vec3& x) const;
  std::vector<Mat3> at(std::span<const Vec3> points, int threads) const;

 private:
  Mat3 on_surface_at(std::size_t triangle, const Vec3& x) const;

  Material material_;
  BoundaryElements elements_;
  InertialField inertia_;
  Eigen::VectorXd displacements_;
  std::vector<Mat3> surface_;
  std::vector<std::array<Mat3, 3>> corners_;  ///< surface stress at the corners of each triangle
  SomiglianaStress inside_;
  TriangleTree tree_;
};

/// The field of a body's stress on `threads` threads. It keeps the body's stress.
StressField stress_field(std::shared_ptr<const BodyStress> stress, int threads);

}  // namespace fracbench::bem
