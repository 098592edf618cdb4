#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "geometry/measures.h"
#include "geometry/overlap.h"
#include "scenarios/rigid/world.h"
#include "scenarios/scene.h"
#include "scenarios/shapes/block_surface.h"
#include "tests/scenarios/test_bodies.h"

namespace fracbench {
namespace {

using test::PlaneSplitter;
using test::TestContext;

constexpr double kStep = 1.0 / 250;

RigidSolid solid_of(const TriangleMesh& mesh, double size, int max_parts = 8) {
  return {.surface = std::make_shared<SurfaceTree>(mesh),
          .frame = mass_frame(mass_properties(mesh), 1000),
          .collider = make_collider(
              mesh, {.gap = 0.002 * size, .tolerance = 0.02 * size, .max_parts = max_parts}),
          .material = {}};
}

double energy(const RigidWorld& world, int body) {
  const BodyState state = world.state(body);
  const MassFrame& frame = world.frame(body);
  return (frame.mass * state.velocity.squaredNorm() +
          state.angular_velocity.dot(frame.world_inertia(state.pose) * state.angular_velocity)) /
         2;
}

/// The largest shift and the kinetic energy of solids that are left alone for 200 frames.
std::pair<double, double> unrest(const std::vector<TriangleMesh>& meshes, int max_parts = 8) {
  RigidWorld world(1.9);
  std::vector<int> bodies;
  for (const TriangleMesh& mesh : meshes) {
    bodies.push_back(world.add_solid(solid_of(mesh, 1.9, max_parts), {}));
  }
  double shift = 0;
  double most_energy = 0;
  for (int frame = 0; frame < 200; ++frame) {
    EXPECT_TRUE(world.advance(kStep).empty());
    for (const int body : bodies) {
      shift = std::max(shift, world.state(body).pose.position.norm());
      most_energy = std::max(most_energy, energy(world, body));
    }
  }
  return {shift, most_energy};
}

/// A cup in two dimensions, and a block that fills it: whatever hull the cup has overlaps the
/// block.
std::vector<TriangleMesh> cup_and_block() {
  return {block_surface({{Vec3(-0.9, -0.5, -0.3), Vec3(0.9, -0.2, 0.3)},
                         {Vec3(-0.9, -0.2, -0.3), Vec3(-0.5, 0.5, 0.3)},
                         {Vec3(0.5, -0.2, -0.3), Vec3(0.9, 0.5, 0.3)}},
                        0.1),
          test::box({1, 0.7, 0.6}, {0, 0.15, 0})};
}

std::vector<TriangleMesh> eighths_of_a_cube() {
  const PlaneSplitter splitter(test::box({1.9, 1.9, 1.9}),
                               {{.normal = Vec3::UnitX(), .offset = 0.1},
                                {.normal = Vec3(0.1, 1, 0.3).normalized(), .offset = -0.05},
                                {.normal = Vec3(0.2, -0.3, 1).normalized(), .offset = 0.02}});
  TestContext test;
  std::vector<TriangleMesh> meshes;
  for (const Piece& piece : splitter.fracture({}, test.context)) meshes.push_back(piece.mesh);
  return meshes;
}

TEST(Aftermath, FragmentsAtRestStayAtRest) {
  const auto [shift, most_energy] = unrest(eighths_of_a_cube());
  EXPECT_LT(shift, 1e-9);
  EXPECT_LT(most_energy, 1e-9);
}

TEST(Aftermath, ConcaveFragmentsAtRestStayAtRestWhateverTheirColliders) {
  for (const int max_parts : {1, 8}) {
    const auto [shift, most_energy] = unrest(cup_and_block(), max_parts);
    EXPECT_LT(shift, 1e-9) << max_parts;
    EXPECT_LT(most_energy, 1e-9) << max_parts;
  }
}

TEST(Aftermath, SolidsThatMeetNeitherPassIntoEachOtherNorGainEnergy) {
  RigidWorld world(1.9);
  const int left = world.add_solid(solid_of(test::box({1, 1, 1}), 1.9), {});
  BodyState moved;
  moved.pose.position = {3, 0, 0};
  moved.velocity = {-20, 0, 0};
  const int right = world.add_solid(solid_of(test::box({1, 1, 1}), 1.9), moved);
  double deepest = 0;
  const double start = energy(world, right);
  for (int frame = 0; frame < 100; ++frame) {
    world.advance(kStep);
    deepest = std::max(deepest, world.deepest_overlap());
    EXPECT_LE(energy(world, left) + energy(world, right), start * (1 + 1e-9));
  }
  // Equal masses: between the plastic blow and the stated restitution. The engine stops solids at a
  // small gap, which takes some of the rebound.
  EXPECT_NEAR(world.state(left).velocity.x() + world.state(right).velocity.x(), -20, 1e-9);
  EXPECT_LT(world.state(left).velocity.x(), -10);
  EXPECT_GT(world.state(left).velocity.x(), -14 - 1e-9);
  EXPECT_LT(deepest, 0.02 * 1.9);
}

TEST(Aftermath, FragmentsOfACollisionDoNotRunIntoEachOtherAndEnergyDoesNotGrow) {
  const TriangleMesh mesh = test::sphere(0.95, 3);
  std::vector<PlaneSplitter::Cut> cuts;
  Random random(5);
  for (int k = 0; k < 5; ++k) {
    cuts.push_back({.normal = random.unit_vector(), .offset = random.uniform(-0.3, 0.3)});
  }
  Scenario scenario;
  scenario.balls = {Ball{.position = {3, 0.3, 0}, .velocity = {-80, 0, 0}}};
  TestContext test;
  const SceneResult result = run_scene(scenario, {.name = "ball", .mesh = mesh, .material = {}},
                                       std::make_shared<PlaneSplitter>(mesh, cuts), test.context);
  ASSERT_GE(result.fragments.size(), 15u);

  const auto at_frame = [&](int frame, auto&& visit) {
    for (const Track& track : result.trajectory.tracks) {
      const int k = frame - track.first_frame;
      if (k < 1 || k >= static_cast<int>(track.poses.size())) continue;
      visit(track, track.poses[k - 1], track.poses[k]);
    }
  };
  const int first = static_cast<int>(result.impacts.at(0).time * 250 + 0.5) + 2;
  const double ball_mass = 8900 * 4.0 / 3 * M_PI * 0.4 * 0.4 * 0.4;
  for (int frame = first; frame <= 200; frame += frame < first + 10 ? 2 : 30) {
    std::vector<TriangleMesh> placed;
    double linear_energy = 0;
    at_frame(frame, [&](const Track& track, const Pose& last, const Pose& pose) {
      if (track.kind != Track::Kind::piece) {
        linear_energy += ball_mass / 2 * ((pose.position - last.position) / kStep).squaredNorm();
        return;
      }
      TriangleMesh moved = std::ranges::find(result.fragments, track.index, &Fragment::piece)->mesh;
      const MassProperties whole = mass_properties(moved);
      linear_energy +=
          1000 * whole.volume / 2 *
          ((pose.to_world(whole.center) - last.to_world(whole.center)) / kStep).squaredNorm();
      for (Vec3& vertex : moved.vertices) vertex = pose.to_world(vertex);
      placed.push_back(std::move(moved));
    });
    EXPECT_LE(linear_energy, ball_mass / 2 * 80 * 80 * (1 + 1e-9)) << frame;
    const std::vector<std::reference_wrapper<const TriangleMesh>> solids(placed.begin(),
                                                                         placed.end());
    for (const Overlap& overlap : find_overlaps(solids, {.tolerance = 1e-3})) {
      EXPECT_LT(overlap.depth, 0.02 * 1.9) << frame;
    }
  }
}

TEST(Colliders, LieWithinTheirSolidByTheGap) {
  const ColliderOptions options{.gap = 0.01, .tolerance = 0.02, .max_parts = 8};
  for (const TriangleMesh& mesh : eighths_of_a_cube()) {
    const Collider collider = make_collider(mesh, options);
    ASSERT_EQ(collider.parts.size(), 1u);
    EXPECT_LT(collider.parts[0].margin, options.gap);
    for (const Vec3& vertex : collider.parts[0].vertices) {
      for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const Vec3 area2 = area_vector2(mesh, f);
        if (area2.norm() < 1e-12) continue;
        EXPECT_LT(area2.normalized().dot(vertex - mesh.corner(f, 0)), -0.9 * options.gap);
      }
    }
  }
}

TEST(Colliders, OfConcaveSolidsLeaveTheirCavitiesFree) {
  const TriangleMesh cup = cup_and_block()[0];
  const Collider collider = make_collider(cup, {.gap = 0.004, .tolerance = 0.04, .max_parts = 8});
  EXPECT_GE(collider.parts.size(), 3u);
  EXPECT_LE(collider.parts.size(), 8u);
  for (const Collider::Part& part : collider.parts) {
    // No part bridges the cavity: a convex one that did would hold points on both sides of it.
    bool left = false;
    bool right = false;
    for (const Vec3& vertex : part.vertices) {
      left = left || (vertex.x() < -0.45 && vertex.y() > -0.1);
      right = right || (vertex.x() > 0.45 && vertex.y() > -0.1);
    }
    EXPECT_FALSE(left && right);
  }
}

}  // namespace
}  // namespace fracbench
