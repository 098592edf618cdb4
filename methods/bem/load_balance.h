#pragma once

#include <Eigen/Core>
#include <string_view>

#include "core/material.h"
#include "methods/bem/boundary_elements.h"

namespace fracbench::bem {

/// How the load on a free body is brought into balance.
enum class LoadBalance {
  min_norm,       ///< the least change of the tractions (in the mean square over the surface) that
                  ///< leaves no net force and torque, as the authors do
  inertia_relief  ///< the body accelerates: rigid acceleration as a body force against the load
};

/// By the names "min-norm" and "inertia-relief". Throws InputError for others.
LoadBalance load_balance(std::string_view name);

/// Net force (N) and torque about `about` (N m) of tractions constant on each triangle.
struct NetLoad {
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
};
NetLoad net_load(const BoundaryElements& elements, const Eigen::Matrix3Xd& tractions,
                 const Vec3& about);

/// A polynomial elastic field with div sigma = density * (linear + angular x y), y = x - centre:
/// the stress of a body that accelerates rigidly. With its boundary tractions taken off the load,
/// what is left is a problem without body force.
struct InertialField {
  Vec3 centre = Vec3::Zero();
  Vec3 linear = Vec3::Zero();   ///< acceleration, m/s^2
  Vec3 angular = Vec3::Zero();  ///< rad/s^2

  bool is_zero() const { return linear.isZero(0) && angular.isZero(0); }
  /// density |y|^2 (linear / (2 lambda + 8 mu) + angular x y / (10 mu)), m.
  Vec3 displacement(const Vec3& x, const Material& material) const;
  Mat3 stress(const Vec3& x, const Material& material) const;  ///< Pa
};

/// A load in balance: tractions for the problem without body force, and the field to add to its
/// solution.
struct BalancedLoad {
  Eigen::Matrix3Xd tractions;  ///< Pa, 3 x triangles
  InertialField inertia;       ///< zero for min_norm
};

/// `elements`: a closed surface. The tractions of the result have no net force and torque (to
/// rounding).
BalancedLoad balance_load(const BoundaryElements& elements, const Eigen::Matrix3Xd& tractions,
                          const Material& material, LoadBalance mode);

}  // namespace fracbench::bem
