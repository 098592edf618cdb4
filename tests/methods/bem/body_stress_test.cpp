#include "methods/bem/body_stress.h"

#include <gtest/gtest.h>

#include <memory>

#include "methods/bem/elastic_operator.h"
#include "methods/bem/surface_stress.h"
#include "methods/bem/triangle_potentials.h"
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

Mat3 some_stress() {
  Mat3 stress;
  stress << 1e6, 3e5, -2e5, 3e5, -5e5, 7e5, -2e5, 7e5, 4e5;
  return stress;
}

BalancedLoad uniform_load(const BoundaryElements& elements, const Mat3& stress) {
  BalancedLoad load{Eigen::Matrix3Xd(3, elements.size()), {}};
  for (std::size_t k = 0; k < elements.size(); ++k) {
    load.tractions.col(static_cast<Eigen::Index>(k)) = stress * elements.normals[k];
  }
  return load;
}

// The midpoint rule on a triangle cut `levels` times.
void sum_potentials(const Corners& c, const Vec3& x, const Vec3& density, int levels,
                    TrianglePotentials& sums) {
  const Vec3 cross = (c[1] - c[0]).cross(c[2] - c[0]);
  if (levels == 0) {
    const Vec3 r = x - (c[0] + c[1] + c[2]) / 3;
    const double area = cross.norm() / 2;
    sums.field += area * r / std::pow(r.norm(), 3);
    sums.third += area * r.dot(density) * r * r.transpose() / std::pow(r.norm(), 5);
    sums.solid_angle += cross.dot(r) / 2 / std::pow(r.norm(), 3);
    return;
  }
  const Vec3 ab = (c[0] + c[1]) / 2;
  const Vec3 bc = (c[1] + c[2]) / 2;
  const Vec3 ca = (c[2] + c[0]) / 2;
  for (const Corners& part :
       {Corners{c[0], ab, ca}, Corners{ab, c[1], bc}, Corners{ca, bc, c[2]}, Corners{ab, bc, ca}}) {
    sum_potentials(part, x, density, levels - 1, sums);
  }
}

TEST(TrianglePotentials, AgreeWithTheMidpointRule) {
  const Corners corners = {Vec3(0.1, 0.2, 0.3), Vec3(1.2, 0.1, 0.2), Vec3(0.4, 0.9, 0.7)};
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  const Vec3 density(0.3, -0.7, 1.1);
  const Vec3 in_plane = corners[0] + 1.5 * (corners[1] - corners[0]);  // on the line of a side
  for (const Vec3& x : {Vec3(0.5, 0.4, 0.9), Vec3(0.5, 0.4, -0.2), Vec3(1.5, 1, 0.3),
                        Vec3(0.6, 0.5, 0.6), in_plane, Vec3(20, -30, 10)}) {
    const TrianglePotentials exact = triangle_potentials(corners, normal, x, density);
    TrianglePotentials sums;
    sum_potentials(corners, x, density, 8, sums);
    EXPECT_LT((exact.field - sums.field).norm(), 1e-4 * sums.field.norm()) << x.transpose();
    EXPECT_LT((exact.third - sums.third).norm(), 1e-4 * sums.third.norm()) << x.transpose();
    EXPECT_NEAR(exact.solid_angle, sums.solid_angle, 1e-4 * sums.field.norm()) << x.transpose();
  }
}

TEST(BodyStress, UniformStressIsUniformEverywhere) {
  PlainContext context;
  const BoundaryElements cube = make_boundary_elements(cube_surface(4));
  const Mat3 strain = (1.3 * some_stress() - 0.3 * some_stress().trace() * Mat3::Identity()) / 3e9;
  Eigen::VectorXd u(static_cast<Eigen::Index>(cube.unknowns()));
  for (std::size_t v = 0; v < cube.vertices.size(); ++v) {
    u.segment<3>(3 * static_cast<Eigen::Index>(v)) = strain * cube.vertices[v];
  }
  const BodyStress stress(cube, u, uniform_load(cube, some_stress()), stone());
  for (const Vec3& x :
       {Vec3(0.5, 0.5, 0.5), Vec3(0.3, 0.31, 0.05), Vec3(0.02, 0.5, 0.01), Vec3(0.25, 0.25, 0),
        Vec3(0, 0, 0), Vec3(1e-9, 0.4, 0.3), Vec3(0.99, 0.98, 0.97), Vec3(0.4, 0.4, 1.01)}) {
    EXPECT_LT((stress.at(x) - some_stress()).norm(), 1e-4 * some_stress().norm()) << x.transpose();
  }
}

TEST(BodyStress, GoesOverSmoothlyFromTheInsideToTheSurface) {
  PlainContext context;
  const ElasticBody body(sphere_surface(1, 2), stone(), context.get());
  BalancedLoad load = uniform_load(body.elements(), some_stress());
  for (std::size_t k = 0; k < body.elements().size(); ++k) {
    load.tractions.col(static_cast<Eigen::Index>(k)) *= 1 + body.elements().centroids[k].x();
  }
  load = balance_load(body.elements(), load.tractions, stone(), LoadBalance::inertia_relief);
  const BodyStress stress(body, load, context.get());
  const Vec3 way = Vec3(0.3, -0.5, 0.7).normalized();
  Mat3 before = stress.at(1.05 * way);
  for (int k = 1; k <= 1000; ++k) {
    const Mat3 next = stress.at((1.05 - 0.5 * k / 1000) * way);
    EXPECT_LT((next - before).norm(), 0.02 * some_stress().norm()) << k;
    before = next;
  }
}

TEST(BodyStress, ManyPointsAtOnceGiveTheSameBytesForAnyThreads) {
  PlainContext context;
  const ElasticBody body(cube_surface(3), stone(), context.get());
  const auto stress = std::make_shared<const BodyStress>(
      body, uniform_load(body.elements(), some_stress()), context.get());
  std::vector<Vec3> points;
  for (int k = 0; k < 100; ++k) points.push_back(Vec3(0.01 * k, 0.3, 0.4));
  const std::vector<Mat3> one = stress_field(stress, 1)(points);
  EXPECT_EQ(one, stress_field(stress, 2)(points));
  EXPECT_EQ(one[40], stress->at(points[40]));
}

// A body that is pushed on one side and accelerates freely: the bar's stress falls linearly from
// the pressure at the pushed end to zero at the free one.
TEST(BodyStress, AnAcceleratedBarIsPressedLessAndLess) {
  PlainContext context;
  Material material = stone();
  material.poisson_ratio = 0;
  TriangleMesh bar = cube_surface(6);
  const ElasticBody body(bar, material, context.get());
  Eigen::Matrix3Xd push = Eigen::Matrix3Xd::Zero(3, body.elements().size());
  for (std::size_t k = 0; k < body.elements().size(); ++k) {
    if (body.elements().normals[k].x() < -0.9) {
      push.col(static_cast<Eigen::Index>(k)) = Vec3(1e6, 0, 0);
    }
  }
  const BalancedLoad load =
      balance_load(body.elements(), push, material, LoadBalance::inertia_relief);
  const BodyStress stress(body, load, context.get());
  for (const double x : {0.2, 0.5, 0.8}) {
    const Mat3 inside = stress.at({x, 0.5, 0.45});
    EXPECT_NEAR(inside(0, 0), -1e6 * (1 - x), 2e4) << x;
    EXPECT_LT(std::abs(inside(1, 1)) + std::abs(inside(2, 2)) + std::abs(inside(0, 1)), 4e4) << x;
  }
}

}  // namespace
}  // namespace fracbench::bem
