#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "tests/app/program.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A cube of side 10 whose corner is at (100, 200, 300): not in the normalised frame.
constexpr const char* kCube =
    "v 100 200 300\nv 110 200 300\nv 110 210 300\nv 100 210 300\n"
    "v 100 200 310\nv 110 200 310\nv 110 210 310\nv 100 210 310\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST(Fracture, BreaksAMeshOfTheUsersOwnInItsOwnPlaceAndScale) {
  const TemporaryFolder folder;
  folder.write("cube.obj", kCube);
  const Answer answer =
      call("fracture cvd cube.obj --ball 3,0,0,-60,0,0 --out broken --json", folder.path());
  ASSERT_EQ(answer.exit_code, 0) << answer.errors;
  const auto result = answer.json();
  EXPECT_EQ(result["status"], "ok");
  EXPECT_EQ(result["closed"], true);
  EXPECT_EQ(result["disjoint"], true);
  EXPECT_NEAR(result["volume_ratio"].get<double>(), 1, 1e-9);
  EXPECT_NEAR(result["surface_retention"].get<double>(), 1, 1e-9);

  const std::size_t count = result["fragment_count"];
  EXPECT_GT(count, 1u);
  EXPECT_EQ(result["volumes"].size(), count);
  double normalised = 0;
  for (const double v : result["volumes"]) normalised += v;
  EXPECT_NEAR(normalised, 10, 1e-8);

  double sum = 0;
  std::size_t files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path() / "broken")) {
    if (entry.path().extension() != ".obj") continue;
    ++files;
    const TriangleMesh mesh = read_mesh(entry.path());
    sum += volume(mesh);
    const BoundingBox box = bounding_box(mesh);
    EXPECT_TRUE((box.low.array() >= Vec3(100, 200, 300).array() - 1e-9).all());
    EXPECT_TRUE((box.high.array() <= Vec3(110, 210, 310).array() + 1e-9).all());
  }
  EXPECT_EQ(files, count);
  EXPECT_NEAR(sum / 1000, 1, 1e-9);
  EXPECT_TRUE(fs::exists(folder.path() / "broken/fragments.glb"));
}

TEST(Fracture, GivesTheSameFilesForTheSameSeedAndOthersForAnother) {
  const TemporaryFolder folder;
  folder.write("cube.obj", kCube);
  const std::string base = "fracture cvd cube.obj --impact 0.95,0,0,-1,0,0,2e5 ";
  ASSERT_EQ(call(base + "--seed 7 --threads 1 --out a", folder.path()).exit_code, 0);
  ASSERT_EQ(call(base + "--seed 7 --threads 2 --out b", folder.path()).exit_code, 0);
  ASSERT_EQ(call(base + "--seed 8 --threads 1 --out c", folder.path()).exit_code, 0);
  EXPECT_EQ(folder.read("a/fragments.glb"), folder.read("b/fragments.glb"));
  EXPECT_NE(folder.read("a/fragments.glb"), folder.read("c/fragments.glb"));
}

TEST(Fracture, ReplacesItsOwnEarlierResultAndNothingElse) {
  const TemporaryFolder folder;
  folder.write("cube.obj", kCube);
  const std::string many =
      "fracture cvd cube.obj --impact 0.95,0,0,-1,0,0,2e5 --set sites=30 --out x";
  const std::string few =
      "fracture cvd cube.obj --impact 0.95,0,0,-1,0,0,2e5 --set sites=2 --out x";
  ASSERT_EQ(call(many, folder.path()).exit_code, 0);
  ASSERT_EQ(call(few, folder.path()).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder.path() / "x/fragment_010.obj"));

  fs::create_directory(folder.path() / "mine");
  folder.write("mine/thesis.txt", "years of work");
  const Answer answer =
      call("fracture cvd cube.obj --ball 3,0,0,-60,0,0 --out mine", folder.path());
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.errors, AllOf(HasSubstr("mine"), HasSubstr("new or empty folder")));
  EXPECT_EQ(folder.read("mine/thesis.txt"), "years of work");
}

TEST(Fracture, RunsASceneThatIsWrittenInAFile) {
  const TemporaryFolder folder;
  folder.write("scene.toml",
               "frames = 20\n[[ball]]\nposition = [3, 0, 0]\nvelocity = [-90, 0, 0]\n");
  const Answer answer =
      call("fracture cvd cube --scenario scene.toml --out broken --json", folder.path());
  ASSERT_EQ(answer.exit_code, 0) << answer.errors;
  const auto result = answer.json();
  EXPECT_EQ(result["status"], "ok");
  EXPECT_GT(result["impacts"][0]["impulses"][0]["magnitude"], 0);
  EXPECT_NEAR(result["metrics"]["stage_times"]["stage_coverage"], 1, 0.02);
  const auto trajectory = nlohmann::json::parse(folder.read("broken/trajectory.json"));
  std::size_t pieces = 0;
  for (const auto& track : trajectory["tracks"]) {
    pieces += track["kind"] == "piece";
    const std::size_t end = track["first_frame"].get<std::size_t>() + track["poses"].size();
    EXPECT_EQ(end == 21, track["kind"] != "target");
  }
  EXPECT_EQ(pieces, result["fragment_count"]);
}

TEST(Fracture, TakesACollisionThatDoesNotBreakAsAResult) {
  const TemporaryFolder folder;
  folder.write("cube.obj", kCube);
  for (const char* ball : {"3,0,0,-0.5,0,0", "3,0,0,60,0,0"}) {
    const Answer answer =
        call(std::string("fracture cvd cube.obj --out whole --json --ball ") + ball, folder.path());
    ASSERT_EQ(answer.exit_code, 0) << answer.errors;
    EXPECT_EQ(answer.json()["status"], "unbroken");
    EXPECT_EQ(answer.json()["fragment_count"], 1);
    EXPECT_FALSE(answer.json()["reason"].get<std::string>().empty());
  }
}

TEST(Fracture, BreaksALightBodyByTheTestThatKnowsItsStrength) {
  const TemporaryFolder folder;
  const std::string base =
      "fracture cvd chair --ball 3,0.1,0.2,-60,0,0 --out x --json --break-test ";
  EXPECT_EQ(call(base + "authors", folder.path()).json()["status"], "unbroken");
  EXPECT_EQ(call(base + "eq2-patch", folder.path()).json()["status"], "ok");
}

struct BadCall {
  const char* arguments;
  const char* message;
};

class FractureRejects : public ::testing::TestWithParam<BadCall> {};

TEST_P(FractureRejects, BadInputWithExitCodeTwoAndAMessageThatNamesIt) {
  const TemporaryFolder folder;
  folder.write("cube.obj", kCube);
  folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  folder.write("nan.obj",
               "v 0 0 nan\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  folder.write("garbage.stl", std::string("\x01\x02\xff\xfe\x00\x7f", 6));
  const Answer answer =
      call(std::string("fracture ") + GetParam().arguments + " --out x", folder.path());
  EXPECT_EQ(answer.exit_code, 2) << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr(GetParam().message));
  EXPECT_FALSE(fs::exists(folder.path() / "x"));
}

INSTANTIATE_TEST_SUITE_P(
    Arguments, FractureRejects,
    ::testing::Values(
        BadCall{"cdv cube.obj --ball 3,0,0,-60,0,0", "did you mean 'cvd'"},
        BadCall{"cvd missing.obj --ball 3,0,0,-60,0,0", "missing.obj"},
        BadCall{"cvd open.obj --ball 3,0,0,-60,0,0", "open edge"},
        BadCall{"cvd nan.obj --ball 3,0,0,-60,0,0", "nan.obj"},
        BadCall{"cvd garbage.stl --ball 3,0,0,-60,0,0", "garbage.stl"},
        BadCall{"cvd cube.obj", "--ball"},
        BadCall{"cvd cube.obj --ball 3,0,0,-60,0", "5 numbers, must be 6"},
        BadCall{"cvd cube.obj --ball 3,0,0,-60,0,0,0", "more than 6"},
        BadCall{"cvd cube.obj --ball 3,0,0,-60,0,fast", "'fast' is not a number"},
        BadCall{"cvd cube.obj --ball 3,0,0,-60,0,inf", "'inf' is not a number"},
        BadCall{"cvd cube.obj --impact 0,0,0,1,0,0,1e5", "surface"},
        BadCall{"cvd cube.obj --impact=-0.95,0,0,1,0,0,-5", "-5"},
        BadCall{"cvd cube.obj --ball 3,0,0,-60,0,0 --set sites=0", "allowed is 1 to"},
        BadCall{"cvd cube.obj --ball 3,0,0,-60,0,0 --set site=5", "did you mean 'sites'"},
        BadCall{"cvd cube.obj --ball 3,0,0,-60,0,0 --set sites", "name=value"},
        BadCall{"cvd cube.obj --ball 3,0,0,-60,0,0 --seed -1", "-1"},
        BadCall{"cvd cube.obj --scenario s.toml --break-test authors", "excludes"},
        BadCall{"cvd cube.obj --scenario none.toml", "none.toml: the scene cannot"},
        BadCall{"cvd cube.obj --ball 3,0,0,-1e9,0,0", "within 10000"},
        BadCall{"cvd cube.obj --ball 3,0,0,-60,0,0 --longest-side nan", "--longest-side"},
        BadCall{"cvd cube.obj --ball 3,0,0,-60,0,0 --format doc", "doc"}));

}  // namespace
}  // namespace fracbench
