#include "scenarios/families.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"
#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "scenarios/first_impact.h"
#include "tests/scenarios/test_bodies.h"

namespace fracbench {
namespace {

std::vector<Scenario> scenes_of(std::string_view family_name, const OptionMap& given = {},
                                std::uint64_t seed = 7, std::string_view shape = "squirrel") {
  const ScenarioFamily& family = find_family(family_name);
  return family.scenes(Options(family.options(), given, family_name), shape, seed);
}

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

std::filesystem::path written(const std::string& name, const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / name;
  std::ofstream(path) << text;
  return path;
}

const std::vector<std::string> kWithoutFile = {
    "single", "dual", "near-shear", "sweep-strength", "sweep-direction", "sweep-hit-point"};

TEST(Families, ALongerRunContainsTheShorterOne) {
  for (const std::string& name : kWithoutFile) {
    const auto shorter = scenes_of(name, {{"count", std::int64_t{3}}});
    const auto longer = scenes_of(name, {{"count", std::int64_t{9}}});
    ASSERT_EQ(shorter.size(), 3u);
    ASSERT_EQ(longer.size(), 9u);
    for (std::size_t k = 0; k < shorter.size(); ++k) {
      EXPECT_EQ(to_json(shorter[k]), to_json(longer[k])) << name;
      EXPECT_EQ(
          to_json(scenario_from_json(nlohmann::ordered_json::parse(to_json(longer[k]).dump())))
              .dump(),
          to_json(longer[k]).dump())
          << name;
    }
  }
}

TEST(Families, ScenesDifferAndHaveNamesOfTheirOwn) {
  for (const std::string& name : kWithoutFile) {
    std::set<std::string> names;
    std::set<std::string> contents;
    for (const Scenario& scenario : scenes_of(name, {{"count", std::int64_t{7}}})) {
      EXPECT_EQ(scenario.family, name);
      EXPECT_TRUE(names.insert(scenario.name).second);
      EXPECT_TRUE(contents.insert(to_json(scenario)["balls"].dump()).second) << name;
    }
  }
}

TEST(Families, OptionsReachTheScene) {
  const OptionMap given = {{"density", 2500.0},       {"strength", 5e7},
                           {"ball_radius", 0.2},      {"ball_density", 7800.0},
                           {"time_step", 0.001},      {"frames", std::int64_t{50}},
                           {"refracture", false},     {"break_test", std::string("eq2-patch")},
                           {"count", std::int64_t{1}}};
  for (const std::string& name : kWithoutFile) {
    const Scenario scenario = scenes_of(name, given).at(0);
    EXPECT_EQ(scenario.material.density, 2500);
    EXPECT_EQ(scenario.material.strength, 5e7);
    EXPECT_EQ(scenario.balls.at(0).radius, 0.2);
    EXPECT_EQ(scenario.balls.at(0).material.density, 7800);
    EXPECT_EQ(scenario.balls.at(0).material.strength, 5e7);
    EXPECT_EQ(scenario.time_step, 0.001);
    EXPECT_EQ(scenario.frames, 50);
    EXPECT_FALSE(scenario.refracture);
    EXPECT_EQ(scenario.break_test, BreakTest::eq2_patch);
  }
}

TEST(Families, SingleIsUniformOverTheSphereAndInSpeed) {
  Vec3 mean = Vec3::Zero();
  double speeds = 0;
  const auto scenes = scenes_of("single", {{"count", std::int64_t{2000}}});
  for (const Scenario& scenario : scenes) {
    const Ball& ball = scenario.balls.at(0);
    EXPECT_NEAR(ball.position.norm(), 3, 1e-12);
    EXPECT_NEAR(ball.position.normalized().dot(ball.velocity.normalized()), -1, 1e-12);
    EXPECT_GE(ball.velocity.norm(), 25 - 1e-9);
    EXPECT_LE(ball.velocity.norm(), 100 + 1e-9);
    mean += ball.position / 3 / 2000;
    speeds += ball.velocity.norm() / 2000;
  }
  EXPECT_LT(mean.norm(), 0.05);
  EXPECT_NEAR(speeds, 62.5, 2);
}

TEST(Families, DualHasTwoBallsApart) {
  for (const Scenario& scenario : scenes_of("dual", {{"count", std::int64_t{300}}})) {
    ASSERT_EQ(scenario.balls.size(), 2u);
    EXPECT_GT((scenario.balls[0].position - scenario.balls[1].position).norm(), 0.8);
  }
  EXPECT_NE(message_of([] {
              scenes_of("dual", {{"start_min", 5.0}});
            }).find("start_max"),
            std::string::npos);
}

TEST(Families, NearShearBlowsCrossTheBarOnBothSidesOfItsMiddle) {
  for (const Scenario& scenario : scenes_of("near-shear")) {
    ASSERT_EQ(scenario.balls.size(), 2u);
    EXPECT_NEAR(scenario.balls[0].velocity.x(), 0, 1e-9);
    EXPECT_LT((scenario.balls[0].velocity + scenario.balls[1].velocity).norm(), 1e-9);
    EXPECT_LT(scenario.balls[0].position.x() * scenario.balls[1].position.x(), 0);
    EXPECT_LE(std::abs(scenario.balls[0].position.x()), 0.25);
  }
}

TEST(Families, NearShearBlowsMeetTheBarAtTheSameTimeAndBreakIt) {
  const Target bar = {.name = "bar", .mesh = test::box({1.9, 0.3, 0.3}), .material = {}};
  test::TestContext test;
  for (const auto& first : find_first_impacts(scenes_of("near-shear"), bar, test.context)) {
    ASSERT_TRUE(first);
    EXPECT_TRUE(first->breaks);
    // The bar is thrown to and fro between the balls within the step: each strikes at least once.
    bool from_above = false;
    bool from_below = false;
    const Vec3 flight = first->impact.strikers.at(0).velocity;
    for (const Impulse& impulse : first->impact.impulses) {
      (impulse.direction.dot(flight) > 0 ? from_above : from_below) = true;
    }
    EXPECT_TRUE(from_above && from_below);
  }
}

TEST(Families, SweepsHitHarderAtTheSameSpot) {
  double last = 0;
  for (const Scenario& scenario : scenes_of("sweep-strength")) {
    test::TestContext test;
    const Target target = {.name = "", .mesh = test::sphere(0.95, 3), .material = {}};
    const auto first = find_first_impact(scenario, target, test.context);
    ASSERT_TRUE(first);
    EXPECT_LT((first->impact.impulses[0].point - Vec3(0.95, 0, 0)).norm(), 1e-5);
    EXPECT_GT(first->impact.impulses[0].magnitude, last);
    last = first->impact.impulses[0].magnitude;
  }
}

TEST(Families, PublishedReadsTheRowsOfTheShape) {
  const auto file = written("conditions.csv",
                            "shape,id,px,py,pz,vx,vy,vz\n"
                            "pot,1,3,0,0,-50,0,0\n"
                            "squirrel,4,0,3,0,0,-60,0\r\n");
  const auto squirrel = scenes_of("published", {{"file", file.string()}});
  ASSERT_EQ(squirrel.size(), 1u);
  EXPECT_EQ(squirrel[0].name, "squirrel-4");
  EXPECT_EQ(squirrel[0].balls[0].position, Vec3(0, 3, 0));
  EXPECT_EQ(squirrel[0].balls[0].velocity, Vec3(0, -60, 0));
  EXPECT_EQ(scenes_of("published", {{"file", file.string()}}, 7, "pot_standin").size(), 1u);
  const std::string message = message_of([&] {
    scenes_of("published", {{"file", file.string()}}, 7, "mug");
  });
  EXPECT_NE(message.find("pot, squirrel"), std::string::npos) << message;
}

TEST(Families, PublishedNamesTheLineThatIsWrong) {
  const auto rows = [](const std::string& text) {
    return message_of([&] {
      scenes_of("published", {{"file", written("bad.csv", text).string()}});
    });
  };
  const std::string header = "shape,id,px,py,pz,vx,vy,vz\n";
  EXPECT_NE(rows(header + "squirrel,1,3,0,0,-50,0,0\nsquirrel,2,3,0,zero,-50,0,0\n").find(":3: pz"),
            std::string::npos);
  EXPECT_NE(rows(header + "squirrel,1,3,0,0\n").find(":2: 5 values"), std::string::npos);
  EXPECT_NE(rows(header + "squirrel,1,3,0,0,0,0,0\n").find("velocity is 0"), std::string::npos);
  EXPECT_NE(rows(header + "squirrel,1,nan,0,0,1,0,0\n").find("finite"), std::string::npos);
  EXPECT_NE(rows("shape,id,px\n").find("'py'"), std::string::npos);
  EXPECT_NE(rows("").find("'shape'"), std::string::npos);
  EXPECT_NE(message_of([] { scenes_of("published"); }).find("'file'"), std::string::npos);
  EXPECT_NE(message_of([] {
              scenes_of("published", {{"file", std::string("/nowhere.csv")}});
            }).find("/nowhere.csv"),
            std::string::npos);
}

TEST(Families, PublishedConditionsRunAndMostBreakSquirrel) {
  const auto folder = test::mesh_folder();
  if (folder.empty()) GTEST_SKIP() << "the folder of development meshes is not there";
  const std::vector<std::pair<std::string, std::size_t>> shapes = {
      {"squirrel", 24}, {"base", 16}, {"pot_standin", 12}, {"bunny", 1}};
  for (const auto& [shape, count] : shapes) {
    const Target target = {.name = shape,
                           .mesh = normalized(read_mesh(folder / (shape + ".obj")), 1.9),
                           .material = {}};
    const auto scenes =
        scenes_of("published", {{"file", (folder / "published_collision_conditions.csv").string()}},
                  7, shape);
    EXPECT_EQ(scenes.size(), count) << shape;
    int breaking = 0;
    int hits = 0;
    test::TestContext test;
    for (const auto& first : find_first_impacts(scenes, target, test.context)) {
      hits += first.has_value();
      breaking += first && first->breaks;
    }
    RecordProperty(shape, breaking);
    EXPECT_EQ(hits, static_cast<int>(count)) << shape;
    if (shape == "squirrel") {
      EXPECT_GE(breaking, 20);
    }
  }
}

TEST(Families, HaveNamesThatAreFoundAndSuggested) {
  for (const auto& family : scenario_families()) {
    EXPECT_EQ(&find_family(family->info().name), family.get());
    EXPECT_FALSE(family->info().summary.empty());
  }
  EXPECT_NE(message_of([] { find_family("singel"); }).find("'single'"), std::string::npos);
  EXPECT_NE(message_of([] {
              scenes_of("single", {{"speed_min", 200.0}});
            }).find("speed_max"),
            std::string::npos);
}

}  // namespace
}  // namespace fracbench
