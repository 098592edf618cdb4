#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <tuple>

#include "source_folder.h"
#include "tests/app/program.h"

namespace fracbench {
namespace {

using testing::HasSubstr;

/// Methods that break a promise each, as shell scripts, and the check that has to find it.
class HostileMethod : public testing::Test {
 protected:
  /// The results of some checks of a script, by name.
  std::map<std::string, std::string> check(const std::string& script, const std::string& only,
                                           const std::string& more = "") {
    folder_.write("hostile.sh", script + "\n");
    answer_ = call("check external --set program=hostile.sh --set interpreter=sh --json --only " +
                       only + " " + more,
                   folder_.path());
    std::map<std::string, std::string> results;
    if (answer_.exit_code != 0 && answer_.exit_code != 3) {
      ADD_FAILURE() << answer_.errors;
      return results;
    }
    for (const auto& row : answer_.json()) {
      results[row["check"]] = row["result"];
      details_[row["check"]] = row["detail"];
    }
    return results;
  }

  /// Two copies of the body, smaller and beside each other.
  static std::string two(const std::string& factor) {
    return "for side in -1 1; do awk -v f=" + factor +
           " -v s=$side '/^v/ {print \"v\", f * $2 + s / 2, f * $3, f * $4; next} {print}' "
           "$1/body.obj > $2/part$side.obj; done";
  }

  TemporaryFolder folder_;
  Answer answer_;
  std::map<std::string, std::string> details_;
};

TEST_F(HostileMethod, ThatLosesVolumeIsFound) {
  auto results = check(two("0.4"), "tags,closed,disjoint,volume,surface,same-seed");
  EXPECT_EQ(results["tags"], "passed");
  EXPECT_EQ(results["closed"], "passed");
  EXPECT_EQ(results["disjoint"], "passed");
  EXPECT_EQ(results["same-seed"], "passed");
  EXPECT_EQ(results["volume"], "failed");
  EXPECT_EQ(results["surface"], "failed");
  EXPECT_THAT(details_["volume"], HasSubstr("|0.128"));
  EXPECT_EQ(answer_.exit_code, 3);
}

TEST_F(HostileMethod, WhoseFragmentsOverlapIsFound) {
  EXPECT_EQ(check(two("0.9"), "disjoint")["disjoint"], "failed");
}

TEST_F(HostileMethod, WhoseFragmentsAreOpenIsFound) {
  EXPECT_EQ(check(two("0.4") + "; sed -i '$d' $2/part1.obj", "closed")["closed"], "failed");
  EXPECT_THAT(details_["closed"], HasSubstr("open"));
}

TEST_F(HostileMethod, WithVerticesThatAreNoNumbersIsFound) {
  EXPECT_EQ(check("sed 's/^v .*/v nan 0 0/' $1/body.obj > $2/a.obj", "tags")["tags"], "failed");
}

TEST_F(HostileMethod, ThatCrashesIsFound) {
  EXPECT_EQ(check("kill -SEGV $$", "tags")["tags"], "failed");
  EXPECT_THAT(details_["tags"], HasSubstr("signal 11"));
}

TEST_F(HostileMethod, ThatHangsIsFound) {
  EXPECT_EQ(check("sleep 1000", "tags", "--seconds 0.5")["tags"], "failed");
  EXPECT_THAT(details_["tags"], HasSubstr("longer than 0.5 s"));
}

TEST_F(HostileMethod, ThatTakesChanceFromElsewhereIsFound) {
  auto results = check("f=0.$(od -An -N2 -tu2 /dev/urandom | tr -d ' ')1; " + two("$f"),
                       "same-seed,const-use");
  EXPECT_EQ(results["same-seed"], "failed");
  EXPECT_EQ(results["const-use"], "failed");
}

TEST_F(HostileMethod, ThatIsNotRandomThoughItSaysSoIsFound) {
  EXPECT_EQ(check(two("0.4"), "other-seed")["other-seed"], "failed");
}

TEST_F(HostileMethod, ThatLeavesFilesBehindIsFound) {
  EXPECT_EQ(check(two("0.4"), "tidy")["tidy"], "passed");
  EXPECT_EQ(check("touch ~/.answers; " + two("0.4"), "tidy")["tidy"], "failed");
  EXPECT_THAT(details_["tidy"], HasSubstr(".answers in HOME"));
  EXPECT_EQ(check("touch $TMPDIR/more; " + two("0.4"), "tidy")["tidy"], "failed");
  // Answers that are kept for the next impact.
  EXPECT_EQ(check("cp $1/body.obj $(dirname $0)/memo; " + two("0.4"), "tidy")["tidy"], "failed");
  EXPECT_THAT(details_["tidy"], HasSubstr("memo"));
}

/// That `confined` fails for the file, and no other check does, of those named or of all.
void expect_only_confined_to_fail(const std::string& method, const std::filesystem::path& file,
                                  const std::string& only = "") {
  TemporaryFolder folder;
  const Answer answer =
      call("check " + method + " --json" + (only.empty() ? "" : " --only " + only), folder.path());
  for (const auto& row : answer.json()) {
    if (row["check"] != "confined") {
      EXPECT_NE(row["result"], "failed") << row;
    } else if (row["result"] != "skipped") {
      EXPECT_EQ(row["result"], "failed");
      EXPECT_EQ(row["detail"], "it leaves " + file.string());
    }
  }
  std::filesystem::remove(file);
}

std::filesystem::path answers_in(const std::filesystem::path& place) {
  return place / ("fracbench-answers-" + std::to_string(::getpid()));
}

const std::string kCutter = FRACBENCH_SOURCE_DIR "/docs/examples/plane_cutter.py";

TEST(CheckCommand, FindsAFileThatAScriptWritesElsewhere) {
  TemporaryFolder folder, elsewhere;
  const auto file = elsewhere.path() / "answers";
  const auto script = folder.write(
      "writing.sh", "echo x > " + file.string() + "; exec python3 " + kCutter + " $1 $2\n");
  expect_only_confined_to_fail("external --set interpreter=sh --set program=" + script.string(),
                               file);
}

TEST(CheckCommand, FindsAFileThatAProgramWritesElsewhereOnceAndForAll) {
  TemporaryFolder folder;
  const auto file = answers_in("/dev/shm");
  std::ifstream cutter(kCutter);
  const auto python =
      folder.write("writing.py", "import pathlib\nanswers = pathlib.Path('" + file.string() +
                                     "')\nif not answers.exists():\n    answers.write_text('x')\n" +
                                     std::string(std::istreambuf_iterator<char>(cutter), {}));
  expect_only_confined_to_fail(
      "external --set interpreter=python3 --set program=" + python.string(), file,
      "confined,tags,same-seed,tidy");  // it writes in the first call alone
}

TEST(CheckCommand, FindsAFileThatALibraryWritesElsewhere) {
  const auto file = answers_in("/var/tmp");
  expect_only_confined_to_fail(
      "plugin --set library=" FRACBENCH_WRITING_PLUGIN " --set settings=" + file.string(), file);
}

TEST_F(HostileMethod, ThatTakesTooMuchMemoryIsFound) {
  const std::string large = "dd if=/dev/zero of=/dev/null bs=200M count=1; ";
  EXPECT_EQ(check(large + two("0.4"), "memory", "--memory-mb 100")["memory"], "failed");
  EXPECT_EQ(check(two("0.4"), "memory")["memory"], "passed");
}

TEST(FractureCommand, TellsAMethodThatLeftTheBodyWholeFromABreakTestThatDidNotFire) {
  TemporaryFolder folder;
  folder.write("whole.sh", "cp $1/body.obj $2/body.obj\n");
  const std::string method = "fracture external cube --set program=whole.sh --set interpreter=sh ";
  EXPECT_THAT(call(method + "--ball 3,0,0,-60,0,0 --out hard", folder.path()).output,
              HasSubstr("the method left the body whole"));
  EXPECT_THAT(call(method + "--ball 3,0,0,-10,0,0 --out soft", folder.path()).output,
              HasSubstr("the break test did not fire"));
}

/// A built-in method, as it is called, and a generated shape.
class BuiltIn : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(BuiltIn, Conforms) {
  const auto& [method, shape] = GetParam();
  TemporaryFolder folder;
  const Answer answer = call("check " + method + " --shapes " + shape, folder.path());
  EXPECT_EQ(answer.exit_code, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("conforms"));
}

const auto kShapes =
    testing::Values("bar", "pot", "mug", "A", "chair", "plinth", "sphere", "cube", "bunny");
INSTANTIATE_TEST_SUITE_P(Cvd, BuiltIn, testing::Combine(testing::Values("cvd"), kShapes));
INSTANTIATE_TEST_SUITE_P(Modes, BuiltIn,
                         testing::Combine(testing::Values("modes --set modes=3 "
                                                          "--set cage_faces=300"),
                                          kShapes));
// At a scale that takes seconds a shape, and with blows that break most of them.
INSTANTIATE_TEST_SUITE_P(Bem, BuiltIn,
                         testing::Combine(testing::Values("bem --set triangles=200 "
                                                          "--set voxel=0.06 --set max_cracks=2 "
                                                          "--set refracture_volume=1 "
                                                          "--impulse 1e6"),
                                          kShapes));

TEST(CheckCommand, RefusesWhatItDoesNotKnow) {
  TemporaryFolder folder;
  EXPECT_EQ(call("check nothing", folder.path()).exit_code, 2);
  EXPECT_EQ(call("check cvd --only nothing", folder.path()).exit_code, 2);
  EXPECT_EQ(call("check cvd --set sites=-4", folder.path()).exit_code, 2);
  EXPECT_EQ(call("check cvd --shapes nothing", folder.path()).exit_code, 2);
  EXPECT_THAT(call("check nearest-pattern", folder.path()).errors, HasSubstr("it learns first"));
}

}  // namespace
}  // namespace fracbench
