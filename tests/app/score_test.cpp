#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/app/program.h"

namespace fracbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// An axis-aligned box as an OBJ file.
std::string box(double x0, double x1, double y1 = 1, double z1 = 1) {
  std::string text;
  for (const double z : {0.0, z1}) {
    for (const double y : {0.0, y1}) {
      for (const double x : {x0, x1}) {
        char line[96];
        std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", x, y, z);
        text += line;
      }
    }
  }
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

class Score : public ::testing::Test {
 protected:
  Score() {
    folder_.write("whole.obj", box(0, 1));
    std::filesystem::create_directory(folder_.path() / "parts");
  }

  nlohmann::json score(const std::string& more = "") {
    const Answer answer = call("score parts --parent whole.obj --json " + more, folder_.path());
    EXPECT_EQ(answer.exit_code, 0) << answer.errors;
    return answer.json();
  }

  TemporaryFolder folder_;
};

TEST_F(Score, KnowsHowMuchOfTheBodyIsThere) {
  folder_.write("parts/a.obj", box(0, 0.25));
  folder_.write("parts/b.obj", box(0.25, 1));
  const auto whole = score();
  EXPECT_EQ(whole["status"], "ok");
  EXPECT_NEAR(whole["volume_ratio"].get<double>(), 1, 1e-12);
  EXPECT_NEAR(whole["surface_retention"].get<double>(), 1, 1e-9);
  EXPECT_NEAR(whole["volumes"][0].get<double>(), 2.5, 1e-9);
  EXPECT_NEAR(whole["volumes"][1].get<double>(), 7.5, 1e-9);

  std::filesystem::remove(folder_.path() / "parts/b.obj");
  const auto part = score();
  EXPECT_NEAR(part["volume_ratio"].get<double>(), 0.25, 1e-12);
  // One end face and a quarter of the four others.
  EXPECT_NEAR(part["surface_retention"].get<double>(), 2.0 / 6, 1e-9);
}

TEST_F(Score, SeesFragmentsThatOverlap) {
  folder_.write("parts/a.obj", box(0, 0.6));
  folder_.write("parts/b.obj", box(0.4, 1));
  const auto result = score();
  EXPECT_EQ(result["status"], "invalid");
  EXPECT_EQ(result["disjoint"], false);
  EXPECT_EQ(result["closed"], true);
}

TEST_F(Score, SeesFragmentsThatAreOpen) {
  folder_.write("parts/a.obj", box(0, 0.5));
  std::string open = box(0.5, 1);
  open.resize(open.rfind("f 2 4"));
  folder_.write("parts/b.obj", open);
  const auto result = score();
  EXPECT_EQ(result["status"], "invalid");
  EXPECT_EQ(result["closed"], false);
}

TEST_F(Score, LooksAlongTheDirectionThatItIsGiven) {
  folder_.write("parts/a.obj", box(0, 0.5));
  folder_.write("parts/b.obj", box(0.5, 1));
  const auto along = score("--direction 2,0,0")["metrics"]["fracture_normals"];
  EXPECT_NEAR(along["normal_along"].get<double>(), 1, 1e-9);
  EXPECT_NEAR(along["normal_across"].get<double>(), 0, 1e-9);
  const auto across = score("--direction 0,0,-1")["metrics"]["fracture_normals"];
  EXPECT_NEAR(across["normal_along"].get<double>(), 0, 1e-9);
  EXPECT_NEAR(across["normal_across"].get<double>(), 1, 1e-9);
}

TEST_F(Score, TakesTheConnectedPartsOfOneFileAsFragments) {
  folder_.write("a.obj", box(0, 1));
  ASSERT_EQ(call("fracture cvd a.obj --impact 0.95,0,0,-1,0,0,2e5 --set sites=6 --out broken",
                 folder_.path())
                .exit_code,
            0);
  const auto folder = call("score broken --parent a.obj --json", folder_.path()).json();
  EXPECT_EQ(folder["fragment_count"], 6);
  EXPECT_EQ(folder["status"], "ok");
  EXPECT_NEAR(folder["volume_ratio"].get<double>(), 1, 1e-9);
  const auto file = call("score broken/fragment_002.obj --parent a.obj --json", folder_.path());
  EXPECT_EQ(file.json()["fragment_count"], 1);
}

TEST_F(Score, RefusesFragmentsOfAnotherPlaceAndEmptyFolders) {
  const Answer empty = call("score parts --parent whole.obj", folder_.path());
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_THAT(empty.errors, HasSubstr("parts"));
  folder_.write("parts/a.obj", box(50, 51));
  const Answer apart = call("score parts --parent whole.obj", folder_.path());
  EXPECT_EQ(apart.exit_code, 2);
  EXPECT_THAT(apart.errors, AllOf(HasSubstr("fragment 0"), HasSubstr("same frame")));
}

}  // namespace
}  // namespace fracbench
