#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kSuite =
    "summary = \"cubes to learn from\"\n"
    "[[shape]]\nname = \"cube\"\nresolution = 4\n"
    "[learning]\nmethod = \"cvd\"\nfamily = \"single\"\ncount = 6\ntrain = 3\ntest = 1\n"
    "[learning.options]\nsites = 5\n"
    "[learning.scenario]\nspeed_min = 60\nframes = 10\n";

class Prepare : public ::testing::Test {
 protected:
  Prepare() { folder_.write("learn.toml", kSuite); }
  Answer prepare(const std::string& more = "") {
    return call("prepare learn.toml --out results " + more, folder_.path());
  }
  TemporaryFolder folder_;
};

TEST_F(Prepare, MakesLearningDataAndSaysWhatItIs) {
  const Answer dry = prepare("--dry-run --json");
  EXPECT_EQ(dry.exit_code, 0) << dry.errors;
  EXPECT_EQ(dry.json()["learning"]["cells"], 6);
  EXPECT_FALSE(fs::exists(folder_.path() / "results"));

  const Answer first = prepare("--json --jobs 2");
  ASSERT_EQ(first.exit_code, 0) << first.errors;
  const auto cube = first.json()["learning"]["shapes"]["cube"];
  EXPECT_EQ(cube["train"], 3);
  EXPECT_EQ(cube["test"], 1);
  EXPECT_EQ(cube["collisions"], 6);
  EXPECT_GT(cube["max_impulse"], 0);
  const auto index = nlohmann::json::parse(folder_.read("results/learning/learning.json"));
  for (const auto& record : index["shapes"]["cube"]["records"]) {
    EXPECT_TRUE(
        fs::exists(folder_.path() / "results/learning" / record["file"].get<std::string>()));
  }
  const Answer again = prepare();
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_THAT(again.output, AllOf(HasSubstr("3 train, 1 test"), HasSubstr("results/learning")));
}

TEST_F(Prepare, SaysThatTooFewBroke) {
  const Answer answer = prepare("--set learning.train=30");
  EXPECT_EQ(answer.exit_code, 4);
  EXPECT_THAT(answer.errors, AllOf(HasSubstr("6 of 6 collisions broke it"),
                                   HasSubstr("31 are needed"), HasSubstr("raise count")));
}

TEST_F(Prepare, PreparesTheMethodsOfASuite) {
  const Answer answer = call("prepare quick --shapes cube,mug --json", folder_.path());
  ASSERT_EQ(answer.exit_code, 0) << answer.errors;
  EXPECT_FALSE(answer.json().contains("learning")) << "the suite learns on other shapes";
  const auto prepared = answer.json()["prepared"];
  ASSERT_GE(prepared.size(), 2u);
  EXPECT_EQ(prepared[0]["prepared"], true);
  EXPECT_EQ(prepared[0]["method"], "cvd");
}

TEST_F(Prepare, ASuiteThatOnlyMakesLearningDataIsNotRun) {
  const Answer answer = call("run learn.toml", folder_.path());
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.errors, HasSubstr("fracbench prepare learn.toml"));
}

}  // namespace
}  // namespace fracbench
