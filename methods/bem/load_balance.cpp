#include "methods/bem/load_balance.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/error.h"
#include "geometry/measures.h"
#include "methods/bem/elastic_operator.h"
#include "methods/bem/surface_stress.h"
#include "methods/bem/triangle_rules.h"

namespace fracbench::bem {
namespace {

// Adds a + b x (c - centre) on each triangle with centroid c, with a and b such that nothing is
// left of force and torque: the change of least mean square.
void remove_net_load(const BoundaryElements& elements, Eigen::Matrix3Xd& tractions) {
  Vec3 centre = Vec3::Zero();
  double area = 0;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    centre += elements.areas[k] * elements.centroids[k];
    area += elements.areas[k];
  }
  centre /= area;
  Mat3 inertia = Mat3::Zero();
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const Vec3 arm = elements.centroids[k] - centre;
    inertia += elements.areas[k] * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  const NetLoad net = net_load(elements, tractions, centre);
  const Vec3 shift = -net.force / area;
  const Vec3 turn = -inertia.ldlt().solve(net.torque);
  for (std::size_t k = 0; k < elements.size(); ++k) {
    tractions.col(static_cast<Eigen::Index>(k)) +=
        shift + turn.cross(elements.centroids[k] - centre);
  }
}

}  // namespace

LoadBalance load_balance(std::string_view name) {
  if (name == "min-norm") return LoadBalance::min_norm;
  if (name == "inertia-relief") return LoadBalance::inertia_relief;
  throw InputError(
      fmt::format("load balance \"{}\" is not known: min-norm or inertia-relief", name));
}

NetLoad net_load(const BoundaryElements& elements, const Eigen::Matrix3Xd& tractions,
                 const Vec3& about) {
  NetLoad net;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const Vec3 force = elements.areas[k] * tractions.col(static_cast<Eigen::Index>(k));
    net.force += force;
    net.torque += (elements.centroids[k] - about).cross(force);
  }
  return net;
}

Vec3 InertialField::displacement(const Vec3& x, const Material& material) const {
  const double mu = shear_modulus(material);
  const Vec3 y = x - centre;
  return material.density * y.squaredNorm() *
         (linear / (2 * lame_lambda(material) + 8 * mu) + angular.cross(y) / (10 * mu));
}

Mat3 InertialField::stress(const Vec3& x, const Material& material) const {
  const double mu = shear_modulus(material);
  const Vec3 y = x - centre;
  Mat3 turn;  // turn y = angular x y
  turn << 0, -angular.z(), angular.y(), angular.z(), 0, -angular.x(), -angular.y(), angular.x(), 0;
  const Vec3 bracket = linear / (2 * lame_lambda(material) + 8 * mu) + turn * y / (10 * mu);
  const Mat3 gradient =
      material.density * (bracket * (2 * y).transpose() + y.squaredNorm() / (10 * mu) * turn);
  return stress_of_gradient(gradient, material);
}

BalancedLoad balance_load(const BoundaryElements& elements, const Eigen::Matrix3Xd& tractions,
                          const Material& material, LoadBalance mode) {
  BalancedLoad load{tractions, {}};
  if (mode == LoadBalance::inertia_relief) {
    const MassProperties mass = mass_properties({elements.vertices, elements.triangles});
    load.inertia.centre = mass.center;
    const NetLoad net = net_load(elements, tractions, mass.center);
    load.inertia.linear = net.force / (material.density * mass.volume);
    load.inertia.angular = (material.density * mass.inertia).ldlt().solve(net.torque);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Corners corners = elements.corners(k);
      for (const TrianglePoint& point : triangle_rule(6)) {
        const Vec3 x =
            corners[0] + point.u * (corners[1] - corners[0]) + point.v * (corners[2] - corners[0]);
        load.tractions.col(static_cast<Eigen::Index>(k)) -=
            point.weight * load.inertia.stress(x, material) * elements.normals[k];
      }
    }
  }
  // Under inertia relief what is left here is the torque that means over triangles lose.
  remove_net_load(elements, load.tractions);
  return load;
}

}  // namespace fracbench::bem
