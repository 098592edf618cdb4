#include "methods/bem/load_balance.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/measures.h"
#include "methods/bem/elastic_operator.h"
#include "tests/methods/bem/plain_context.h"

namespace fracbench::bem {
namespace {

Material stone() {
  Material material;
  material.young_modulus = 3e9;
  material.poisson_ratio = 0.3;
  material.density = 2000;
  return material;
}

// A push on a few triangles of one side, and nothing else.
Eigen::Matrix3Xd one_push(const BoundaryElements& elements) {
  Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, elements.size());
  for (const int k : {1, 5, 6}) tractions.col(k) = Vec3(1e5, -2e5, 3e5);
  return tractions;
}

TEST(LoadBalance, LeavesNoForceAndNoTorque) {
  const BoundaryElements cube = make_boundary_elements(cube_surface(3));
  const Eigen::Matrix3Xd push = one_push(cube);
  const double size = net_load(cube, push, Vec3::Zero()).force.norm();
  for (const LoadBalance mode : {LoadBalance::min_norm, LoadBalance::inertia_relief}) {
    const BalancedLoad load = balance_load(cube, push, stone(), mode);
    const NetLoad net = net_load(cube, load.tractions, Vec3(0.2, 0.3, -4));
    EXPECT_LT(net.force.norm(), 1e-11 * size);
    EXPECT_LT(net.torque.norm(), 1e-10 * size);
  }
}

TEST(LoadBalance, MinNormChangesABalancedLoadByNothing) {
  const BoundaryElements cube = make_boundary_elements(cube_surface(3));
  const BalancedLoad once = balance_load(cube, one_push(cube), stone(), LoadBalance::min_norm);
  const BalancedLoad twice = balance_load(cube, once.tractions, stone(), LoadBalance::min_norm);
  EXPECT_LT((twice.tractions - once.tractions).norm(), 1e-12 * once.tractions.norm());
  EXPECT_TRUE(once.inertia.is_zero());
}

// Any other change that balances the load is larger, since it differs by a balanced one.
TEST(LoadBalance, MinNormMakesTheLeastChange) {
  const BoundaryElements cube = make_boundary_elements(cube_surface(3));
  const Eigen::Matrix3Xd push = one_push(cube);
  const Eigen::Matrix3Xd change =
      balance_load(cube, push, stone(), LoadBalance::min_norm).tractions - push;
  Eigen::Matrix3Xd other = Eigen::Matrix3Xd::Zero(3, cube.size());
  for (const int k : {0, 10, 30}) other.col(k) = Vec3(-3, 5, 7);
  const Eigen::Matrix3Xd balanced =
      balance_load(cube, other, stone(), LoadBalance::min_norm).tractions;
  double product = 0;
  for (Eigen::Index k = 0; k < change.cols(); ++k) {
    product += cube.areas[k] * change.col(k).dot(balanced.col(k));
  }
  EXPECT_NEAR(product, 0, 1e-10 * change.norm() * balanced.norm());
}

TEST(LoadBalance, InertiaReliefAcceleratesTheBodyAsNewtonAndEulerSay) {
  const TriangleMesh mesh = cube_surface(3);
  const BoundaryElements cube = make_boundary_elements(mesh);
  const Eigen::Matrix3Xd push = one_push(cube);
  const BalancedLoad load = balance_load(cube, push, stone(), LoadBalance::inertia_relief);
  const NetLoad net = net_load(cube, push, Vec3(0.5, 0.5, 0.5));
  EXPECT_LT((2000 * load.inertia.linear - net.force).norm(), 1e-10 * net.force.norm());
  EXPECT_LT((2000.0 / 6 * load.inertia.angular - net.torque).norm(), 1e-10 * net.torque.norm());
}

TEST(LoadBalance, TheInertialFieldFulfilsTheEquationOfMotion) {
  const Material material = stone();
  const InertialField field{.centre = {0.1, 0.2, 0.3}, .linear = {3, -4, 5}, .angular = {7, 1, -2}};
  const Vec3 x(0.6, -0.4, 0.9);
  const double step = 1e-4;
  Vec3 divergence = Vec3::Zero();
  Mat3 gradient;
  for (int k = 0; k < 3; ++k) {
    const Vec3 shift = step * Vec3::Unit(k);
    divergence +=
        (field.stress(x + shift, material) - field.stress(x - shift, material)).col(k) / (2 * step);
    gradient.col(k) =
        (field.displacement(x + shift, material) - field.displacement(x - shift, material)) /
        (2 * step);
  }
  const Vec3 expected = material.density * (field.linear + field.angular.cross(x - field.centre));
  EXPECT_LT((divergence - expected).norm(), 1e-6 * expected.norm());
  const double nu = material.poisson_ratio;
  const Mat3 strain = (gradient + gradient.transpose()) / 2;
  const Mat3 stress = material.young_modulus / (1 + nu) *
                      (strain + nu / (1 - 2 * nu) * strain.trace() * Mat3::Identity());
  EXPECT_LT((stress - field.stress(x, material)).norm(), 1e-6 * stress.norm());
}

TEST(LoadBalance, ModesHaveNames) {
  EXPECT_EQ(load_balance("min-norm"), LoadBalance::min_norm);
  EXPECT_EQ(load_balance("inertia-relief"), LoadBalance::inertia_relief);
  EXPECT_THROW(load_balance("none"), InputError);
}

}  // namespace
}  // namespace fracbench::bem
