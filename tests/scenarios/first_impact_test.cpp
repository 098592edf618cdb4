#include "scenarios/first_impact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "scenarios/families.h"
#include "tests/scenarios/test_bodies.h"

namespace fracbench {
namespace {

using test::TestContext;

double mass(const Ball& ball) {
  return ball.material.density * 4 / 3 * std::numbers::pi * std::pow(ball.radius, 3);
}

TEST(FirstImpact, OfAHeadOnBlowHasTheClosedFormImpulse) {
  const TriangleMesh mesh = test::sphere(0.95, 5);
  for (const double speed : {5.0, 31.7, 100.0}) {
    TestContext test;
    Scenario scenario;
    // Aimed at a corner of the mesh, where the sphere is met at its exact radius and normal.
    scenario.balls = {Ball{.position = {3, 0, 0}, .velocity = {-speed, 0, 0}}};
    const auto first =
        find_first_impact(scenario, {.name = "", .mesh = mesh, .material = {}}, test.context);
    ASSERT_TRUE(first);
    ASSERT_EQ(first->impact.impulses.size(), 1u);
    const double m1 = mass(scenario.balls[0]);
    const double m2 = 1000 * volume(mesh);
    const double expected = (1 + 0.4) * m1 * m2 / (m1 + m2) * speed;
    const Impulse& impulse = first->impact.impulses[0];
    EXPECT_NEAR(impulse.magnitude / expected, 1, 0.001) << speed;
    EXPECT_LT((impulse.direction - Vec3(-1, 0, 0)).norm(), 1e-6);
    EXPECT_LT((impulse.point - Vec3(0.95, 0, 0)).norm(), 1e-6);
  }
}

TEST(FirstImpact, DoesNotDependOnHowFinelyTheMeshIsDivided) {
  TriangleMesh mesh = test::box({1.9, 1.2, 0.8});
  TestContext test;
  Scenario scenario;
  scenario.balls = {Ball{.position = {2, 1.5, 1.2}, .velocity = {-40, -30, -20}}};
  const auto coarse =
      find_first_impact(scenario, {.name = "", .mesh = mesh, .material = {}}, test.context);
  for (int level = 0; level < 5; ++level) mesh = test::refined(mesh);
  const auto fine =
      find_first_impact(scenario, {.name = "", .mesh = mesh, .material = {}}, test.context);
  ASSERT_TRUE(coarse && fine);
  const Impulse& a = coarse->impact.impulses[0];
  const Impulse& b = fine->impact.impulses[0];
  EXPECT_NEAR(b.magnitude / a.magnitude, 1, 0.02);
  EXPECT_LT((a.point - b.point).norm(), 0.01);
  EXPECT_GT(a.direction.dot(b.direction), 0.999);
}

TEST(FirstImpact, DoesNotDependOnWhereInTheStepItFalls) {
  const TriangleMesh mesh = test::sphere(0.95, 4);
  std::vector<Impulse> impulses;
  for (int phase = 0; phase < 20; ++phase) {
    TestContext test;
    Scenario scenario;
    // The ball flies 0.4 m in a step: each start meets the target at another time within it.
    scenario.balls = {Ball{.position = {3 + 0.02 * phase, 0.6, 0.3}, .velocity = {-100, 0, 0}}};
    const auto first =
        find_first_impact(scenario, {.name = "", .mesh = mesh, .material = {}}, test.context);
    ASSERT_TRUE(first);
    impulses.push_back(first->impact.impulses.at(0));
    EXPECT_NEAR(first->impact.strikers[0].velocity.x(), -100, 1e-9);
  }
  for (const Impulse& impulse : impulses) {
    EXPECT_NEAR(impulse.magnitude / impulses[0].magnitude, 1, 1e-3);
    EXPECT_LT((impulse.point - impulses[0].point).norm(), 1e-3);
    EXPECT_GT(impulse.direction.dot(impulses[0].direction), 1 - 1e-6);
  }
}

TEST(FirstImpact, LiesOnTheSurfaceOfAConcaveTargetAndNotOnItsHull) {
  // Two boxes joined by a thin one: a ball that fits between them meets the floor of the notch.
  TriangleMesh mesh = test::box({0.4, 1, 1}, {-0.9, 0, 0});
  const auto join = [&](const TriangleMesh& other) {
    const auto offset = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const Face& f : other.faces) {
      mesh.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
    }
  };
  join(test::box({0.4, 1, 1}, {0.9, 0, 0}));
  join(test::box({1.3, 1, 0.2}));
  TestContext test;
  Scenario scenario;
  scenario.balls = {Ball{.position = {0, 0, 3}, .velocity = {0, 0, -50}}};
  const auto first =
      find_first_impact(scenario, {.name = "", .mesh = mesh, .material = {}}, test.context);
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->impact.impulses[0].point.z(), 0.1, 1e-6);
}

TEST(FirstImpact, IsNothingWhereTheBallMisses) {
  TestContext test;
  Scenario scenario;
  scenario.balls = {Ball{.position = {3, 1.5, 0}, .velocity = {-60, 0, 0}}};
  EXPECT_FALSE(find_first_impact(
      scenario, {.name = "", .mesh = test::box({1, 1, 1}), .material = {}}, test.context));
}

TEST(FirstImpact, BreaksSquirrelInAsManySinglesAsThePublishedRuns) {
  const auto folder = test::mesh_folder();
  if (folder.empty()) GTEST_SKIP() << "the folder of development meshes is not there";
  const Target target = {
      .name = "squirrel", .mesh = read_mesh(folder / "squirrel.obj"), .material = {}};
  const ScenarioFamily& family = find_family("single");
  const Options options(family.options(), {{"count", std::int64_t{300}}}, "test");
  int hits = 0;
  int broken = 0;
  double slowest_breaking = 1e300;
  const std::vector<Scenario> scenes = family.scenes(options, "squirrel", 1);
  TestContext test;
  const auto impacts = find_first_impacts(scenes, target, test.context);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const auto& first = impacts[k];
    if (!first) continue;
    ++hits;
    const double speed = scenes[k].balls[0].velocity.norm();
    broken += first->breaks;
    if (first->breaks) slowest_breaking = std::min(slowest_breaking, speed);
  }
  RecordProperty("hits", hits);
  RecordProperty("broken", broken);
  EXPECT_EQ(hits, 300);
  EXPECT_GE(broken, 225);  // 75 and 92 %
  EXPECT_LE(broken, 276);
  EXPECT_GT(slowest_breaking, 28);
}

}  // namespace
}  // namespace fracbench
