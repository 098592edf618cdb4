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

TEST_F(Prepare, TakesCollisionsFromTheCacheWhichCanBeListedVerifiedAndPruned) {
  const fs::path cache = folder_.path() / "cache";
  const auto with_cache = [&](const std::string& arguments) {
    return call(arguments, folder_.path(), cache);
  };
  for (const char* out : {"one", "two"}) {
    const Answer made = with_cache(std::string("prepare learn.toml --out ") + out);
    EXPECT_EQ(made.exit_code, 0) << made.errors;
  }
  EXPECT_EQ(folder_.read("one/learning/learning.json"), folder_.read("two/learning/learning.json"));
  const auto list = with_cache("cache list --json").json();
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0]["kind"], "collisions");
  EXPECT_EQ(list[0]["collisions"], 6);
  EXPECT_EQ(list[0]["shape"], "cube");
  EXPECT_THAT(with_cache("cache list").output, HasSubstr("6 collisions"));

  const fs::path entry = cache / "collisions" / list[0]["key"].get<std::string>();
  for (const auto& item : fs::directory_iterator(entry)) {
    if (item.path().extension() != ".h5") continue;
    fs::resize_file(item.path(), fs::file_size(item.path()) / 2);
    break;
  }
  EXPECT_EQ(with_cache("cache verify").exit_code, 2);
  EXPECT_EQ(with_cache("cache prune --damaged").exit_code, 0);
  EXPECT_EQ(with_cache("cache verify").exit_code, 0);
  EXPECT_EQ(with_cache("cache list --json").json()[0]["collisions"], 5);
  EXPECT_EQ(with_cache("cache prune --keep-mb 0").exit_code, 0);
  EXPECT_FALSE(fs::exists(entry));
  EXPECT_EQ(call("cache list", folder_.path()).exit_code, 2) << "there is no cache";
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
