#include "methods/bem/contact_load.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "methods/bem/load_balance.h"
#include "methods/bem/validation/known_fields.h"
#include "tests/methods/bem/plain_context.h"

namespace fracbench::bem {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Hertz, DurationIsThatOfTheEquationOfMotion) {
  for (const HertzContact& contact :
       {HertzContact{100, 1.7e9, 0.2, 25}, HertzContact{1e-3, 2e11, 0.01, 1},
        HertzContact{5, 1e6, 3, 0.1}}) {
    EXPECT_NEAR(contact_duration(contact) / integrated_contact_duration(contact), 1, 0.01);
  }
}

TEST(Hertz, AtTheLargestPatchAllEnergyIsElastic) {
  const HertzContact contact{100, 1.7e9, 0.2, 25};
  const double depth = std::pow(contact_radius(contact), 2) / contact.radius;
  EXPECT_NEAR(8.0 / 15 * contact.modulus * std::sqrt(contact.radius) * std::pow(depth, 2.5),
              contact.mass * 25 * 25 / 2, 1e-9 * contact.mass * 25 * 25);
}

TEST(Hertz, AnImpulseThroughTheCentreMeetsTheWholeMass) {
  const Mat3 inertia = Vec3(2, 3, 4).asDiagonal();
  EXPECT_NEAR(effective_mass(5, inertia, {0, 0, 0}, {1, 0, 0}, {-1, 0, 0}), 5, 1e-14);
  EXPECT_NEAR(effective_mass(5, inertia, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}), 1 / (1.0 / 5 + 1.0 / 3),
              1e-14);
}

TEST(Hertz, AreaInABallIsThatOfTheDiscOrOfTheTriangle) {
  const Corners large = {Vec3(-10, -10, 0.3), Vec3(20, -10, 0.3), Vec3(-10, 20, 0.3)};
  EXPECT_NEAR(area_in_ball(large, {0, 0, 0}, 0.5), kPi * 0.16, 1e-12);
  EXPECT_EQ(area_in_ball(large, {0, 0, 0}, 0.3), 0);
  const Corners small = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  EXPECT_NEAR(area_in_ball(small, {0.2, 0.3, 0.1}, 5), 0.5, 1e-14);
  EXPECT_NEAR(area_in_ball(small, {0, 0, 0}, 0.5), kPi * 0.25 / 4, 1e-14);
  EXPECT_NEAR(area_in_ball(small, {0.5, 0, 0}, 0.2), kPi * 0.04 / 2, 1e-14);
  EXPECT_EQ(area_in_ball(small, {3, 3, 0}, 1), 0);
}

TEST(Hertz, MeanCurvatureOfASphereIsOneOverItsRadius) {
  for (const int level : {2, 3, 4}) {
    const BoundaryElements sphere = make_boundary_elements(sphere_surface(2, level));
    const Vec3 normal = Vec3(1, 2, 3).normalized();
    EXPECT_NEAR(mean_curvature(sphere, 2 * normal, normal, 1), 0.5, 0.05) << level;
  }
  const BoundaryElements cube = make_boundary_elements(cube_surface(4));
  EXPECT_NEAR(mean_curvature(cube, {0.5, 0.5, 1}, {0, 0, 1}, 0.2), 0, 1e-12);
}

TEST(Hertz, MeanCurvatureOfAHollowIsNegative) {
  TriangleMesh sphere = sphere_surface(2, 3);
  for (Face& face : sphere.faces) std::swap(face[0], face[1]);
  EXPECT_NEAR(mean_curvature(make_boundary_elements(sphere), {2, 0, 0}, {-1, 0, 0}, 1), -0.5, 0.05);
}

ContactPatch patch_on_top(double radius) {
  return {.point = {0.45, 0.4, 1},
          .direction = Vec3(0.2, 0, -1).normalized(),
          .normal = {0, 0, 1},
          .radius = radius,
          .force = 7,
          .duration = 1e-3};
}

TEST(ContactLoad, NetForceIsThatOfThePatchesOnAnyMesh) {
  for (const int cells : {1, 3, 8}) {
    const BoundaryElements cube = make_boundary_elements(cube_surface(cells));
    for (const double radius : {1e-6, 0.1, 0.3}) {
      const ContactPatch patch = patch_on_top(radius);
      ContactPatch other = patch;
      other.point = {0.5, 1, 0.5};
      other.normal = {0, 1, 0};
      other.direction = {0, -1, 0};
      const std::vector<ContactPatch> both = {patch, other};
      const NetLoad net = net_load(cube, contact_tractions(cube, both), Vec3::Zero());
      EXPECT_LT((net.force - 7 * patch.direction - 7 * other.direction).norm(), 1e-12);
    }
  }
}

TEST(ContactLoad, TorqueApproachesThatOfTheForceAtThePointAsTheMeshGetsFiner) {
  double before = 1;
  for (const int cells : {4, 8, 16}) {
    const BoundaryElements cube = make_boundary_elements(cube_surface(cells));
    const ContactPatch patch = patch_on_top(0.2);
    const NetLoad net = net_load(cube, contact_tractions(cube, {&patch, 1}), patch.point);
    EXPECT_LT(net.torque.norm(), 0.6 * before);
    before = net.torque.norm();
  }
  EXPECT_LT(before, 0.01 * 7);
}

TEST(ContactLoad, APatchLeavesTheFarSideOfAThinPlateAlone) {
  TriangleMesh plate = cube_surface(6);
  for (Vec3& v : plate.vertices) v.z() = 1 + 0.05 * (v.z() - 1);
  const BoundaryElements elements = make_boundary_elements(plate);
  const ContactPatch patch = patch_on_top(0.3);
  const Eigen::Matrix3Xd tractions = contact_tractions(elements, {&patch, 1});
  for (std::size_t k = 0; k < elements.size(); ++k) {
    if (elements.normals[k].z() < 0.5) {
      EXPECT_TRUE(tractions.col(static_cast<Eigen::Index>(k)).isZero(0));
    }
  }
}

Impact ball_on_sphere() {
  Impulse impulse{
      .point = {0, 0, 1}, .direction = {0, 0, -1}, .magnitude = 10, .normal = {0, 0, 1}};
  Striker striker{.mass = 50,
                  .radius = 0.5,
                  .young_modulus = 1e9,
                  .poisson_ratio = 0.2,
                  .velocity = {3, 0, -4}};
  Impact impact;
  impact.impulses = {impulse};
  impact.strikers = {striker};
  return impact;
}

TEST(ContactLoad, TheCollisionIsThatOfBothBodies) {
  const BoundaryElements sphere = make_boundary_elements(sphere_surface(1, 4));
  Material material;
  material.young_modulus = 2e9;
  material.poisson_ratio = 0.3;
  material.density = 100;
  const Impact impact = ball_on_sphere();
  const HertzContact contact =
      hertz_contact(sphere, material, impact.impulses[0], impact.strikers[0]);
  EXPECT_NEAR(contact.mass, 1 / (1 / (400 * kPi / 3) + 1.0 / 50), 0.1);
  EXPECT_NEAR(contact.modulus, 1 / (0.91 / 2e9 + 0.96 / 1e9), 1);
  EXPECT_NEAR(contact.radius, 1 / (1 + 1 / 0.5), 0.05);
  EXPECT_DOUBLE_EQ(contact.speed, 4);
  const std::vector<ContactPatch> patches = contact_patches(sphere, material, impact);
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_DOUBLE_EQ(patches[0].force * patches[0].duration, 10);
  EXPECT_DOUBLE_EQ(load_duration(patches), contact_duration(contact));
}

TEST(ContactLoad, AStrikerThatMovesAwayHasTheSpeedOfItsImpulse) {
  const BoundaryElements sphere = make_boundary_elements(sphere_surface(1, 2));
  Impact impact = ball_on_sphere();
  impact.strikers[0].velocity = Vec3::Zero();
  const HertzContact contact = hertz_contact(sphere, {}, impact.impulses[0], impact.strikers[0]);
  EXPECT_DOUBLE_EQ(contact.speed, 10 / contact.mass);
}

TEST(ContactLoad, ImpossibleStrikersAndImpulsesAreRefused) {
  const BoundaryElements sphere = make_boundary_elements(sphere_surface(1, 1));
  Impact impact = ball_on_sphere();
  impact.strikers[0].radius = 0;
  EXPECT_THROW(contact_patches(sphere, {}, impact), InputError);
  impact = ball_on_sphere();
  impact.impulses[0].magnitude = std::nan("");
  EXPECT_THROW(contact_patches(sphere, {}, impact), InputError);
  impact = ball_on_sphere();
  impact.strikers.clear();
  EXPECT_THROW(contact_patches(sphere, {}, impact), InputError);
}

}  // namespace
}  // namespace fracbench::bem
