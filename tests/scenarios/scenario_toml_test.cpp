#include "scenarios/scenario_toml.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "core/error.h"

namespace fracbench {
namespace {

Scenario parsed(const std::string& text) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "my_scene.toml";
  std::ofstream(file) << text;
  return read_scenario(file);
}

std::string message_of(const std::string& text) {
  try {
    parsed(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

const std::string kBall = "[[ball]]\nposition = [3, 0, 0.5]\nvelocity = [-60.5, 0, 0]\n";

TEST(ScenarioToml, ReadsWhatIsGivenAndLeavesTheRestAtThePapersValues) {
  const Scenario scenario =
      parsed("break_test = 'eq2-face'\nframes = 60\n[material]\nstrength = 1e6\n" + kBall +
             "radius = 0.3\ndensity = 7800\n" + kBall);
  EXPECT_EQ(scenario.name, "my_scene");
  EXPECT_EQ(scenario.break_test, BreakTest::eq2_face);
  EXPECT_EQ(scenario.frames, 60);
  EXPECT_EQ(scenario.time_step, 1.0 / 250);
  EXPECT_EQ(scenario.material.strength, 1e6);
  EXPECT_EQ(scenario.material.density, 1000);
  ASSERT_EQ(scenario.balls.size(), 2u);
  EXPECT_EQ(scenario.balls[0].position, Vec3(3, 0, 0.5));
  EXPECT_EQ(scenario.balls[0].velocity, Vec3(-60.5, 0, 0));
  EXPECT_EQ(scenario.balls[0].radius, 0.3);
  EXPECT_EQ(scenario.balls[0].material.density, 7800);
  EXPECT_EQ(scenario.balls[1].radius, 0.4);
  EXPECT_EQ(scenario.balls[1].material.density, 8900);
}

TEST(ScenarioToml, NamesFileLineAndNearestKeyOfWhatIsWrong) {
  EXPECT_NE(message_of("frames = 60\nbreak_tset = 'authors'\n" + kBall)
                .find("my_scene.toml:2: unknown key 'break_tset'; did you mean 'break_test'?"),
            std::string::npos);
  EXPECT_NE(message_of(kBall + "radios = 1\n").find(":4: unknown key 'radios'"), std::string::npos);
  EXPECT_NE(
      message_of("[material]\npoisson_ratio = 0.7\n" + kBall).find(":2: option 'poisson_ratio'"),
      std::string::npos);
  EXPECT_NE(message_of("time_step = 2\n" + kBall).find("0.1 s"), std::string::npos);
  EXPECT_NE(message_of("frames = 'many'\n" + kBall).find("whole number"), std::string::npos);
  EXPECT_NE(message_of("[[ball]]\nposition = [1, 2]\nvelocity = [1, 2, 3]\n").find("three numbers"),
            std::string::npos);
  EXPECT_NE(message_of("[[ball]]\nposition = [1, 2, 3]\n").find("'velocity'"), std::string::npos);
  EXPECT_NE(message_of("frames = 60\n").find("[[ball]]"), std::string::npos);
  EXPECT_NE(message_of("[ball]\nradius = 1\n").find("[[ball]]"), std::string::npos);
  EXPECT_NE(message_of("material = 3\n" + kBall).find("[material]"), std::string::npos);
  EXPECT_NE(message_of("frames = = 3\n").find("my_scene.toml:1"), std::string::npos);
  EXPECT_THROW(read_scenario("/nowhere.toml"), InputError);
}

}  // namespace
}  // namespace fracbench
