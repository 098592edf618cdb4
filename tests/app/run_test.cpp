#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/app/program.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kSuite =
    "summary = \"two impacts on a coarse cube\"\n"
    "[[shape]]\nname = \"cube\"\nresolution = 4\n"
    "[[scenario]]\nfamily = \"single\"\ncount = 2\nspeed_min = 90\nframes = 20\n"
    "[[method]]\nname = \"cvd\"\nsites = 5\n";

class Run : public ::testing::Test {
 protected:
  Run() { folder_.write("small.toml", kSuite); }
  Answer run(const std::string& more = "") {
    return call("run small.toml --out results --json " + more, folder_.path());
  }
  TemporaryFolder folder_;
};

TEST_F(Run, MeasuresASuiteOnceAndReportsIt) {
  const Answer first = run();
  ASSERT_EQ(first.exit_code, 0) << first.errors;
  EXPECT_EQ(first.json()["cells"], 2);
  EXPECT_EQ(first.json()["ok"], 2);
  EXPECT_EQ(run().json()["found"], 2);

  const Answer report = call("report results", folder_.path());
  ASSERT_EQ(report.exit_code, 0) << report.errors;
  const std::string text = folder_.read("results/report/report.md");
  EXPECT_THAT(text, AllOf(HasSubstr("# small"), HasSubstr("two impacts on a coarse cube"),
                          HasSubstr("Fragment volumes against Mott's law")));
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder_.path() / "results/report")) {
    files.insert(entry.path().filename());
  }
  EXPECT_TRUE(files.contains("cells.csv"));
  EXPECT_TRUE(files.contains("volumes.csv"));
}

TEST_F(Run, AnswersADryRunWithoutMeasuring) {
  const Answer answer = call("run small.toml --out results --dry-run", folder_.path());
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.output, HasSubstr("2 cells"));
  EXPECT_FALSE(fs::exists(folder_.path() / "results"));
}

TEST_F(Run, RefusesAFolderThatBelongsToAnotherSuiteAndLeavesItAlone) {
  ASSERT_EQ(run().exit_code, 0);
  const Answer other = run("--set seed=9");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.errors, AllOf(HasSubstr("results"), HasSubstr("seed: 1 there, 9 here")));
  EXPECT_EQ(run().json()["found"], 2);
}

TEST_F(Run, SetsARecordAsideThatWasCutShortAndMeasuresItAgain) {
  ASSERT_EQ(run().exit_code, 0);
  const fs::path record = fs::directory_iterator(folder_.path() / "results/records")->path();
  const auto size = fs::file_size(record);
  fs::resize_file(record, size / 2);
  const Answer again = run();
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(again.json()["ok"], 2);
  EXPECT_EQ(again.json()["found"], 1);
  EXPECT_THAT(again.errors, HasSubstr(record.filename().string()));
  EXPECT_EQ(fs::file_size(record), size);
}

TEST_F(Run, NamesTheFileTheLineAndTheNearestKeyForAMistakeInASuite) {
  folder_.write("bad.toml", std::string(kSuite) + "sitess = 3\n");
  const Answer answer = call("run bad.toml --out results", folder_.path());
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.errors,
              AllOf(HasSubstr("bad.toml"), HasSubstr("sitess"), HasSubstr("did you mean 'sites'")));
}

TEST_F(Run, SaysThatThereIsNothingToReport) {
  EXPECT_EQ(call("report .", folder_.path()).exit_code, 2);
  EXPECT_EQ(call("report nowhere", folder_.path()).exit_code, 2);
}

TEST(List, GivesOneJsonArrayOfNamedThingsForEachKind) {
  const TemporaryFolder folder;
  for (const char* what : {"methods", "metrics", "scenarios", "shapes", "suites"}) {
    const auto list = call(std::string("list --json ") + what, folder.path()).json();
    ASSERT_TRUE(list.is_array() && !list.empty()) << what;
    for (const auto& item : list) {
      EXPECT_FALSE(item.at("name").get<std::string>().empty());
      EXPECT_FALSE(item.at("summary").get<std::string>().empty());
    }
  }
  const auto method = call("list methods --json", folder.path()).json()[0];
  for (const char* name : {"citation", "shape_type", "retains_surface", "refracture", "options"}) {
    EXPECT_TRUE(method.contains(name)) << name;
  }
}

TEST(Usage, MistakesAreAnsweredWithExitCodeTwo) {
  const TemporaryFolder folder;
  EXPECT_EQ(call("", folder.path()).exit_code, 2);
  EXPECT_EQ(call("fracture", folder.path()).exit_code, 2);
  EXPECT_EQ(call("list nothing", folder.path()).exit_code, 2);
  const Answer unknown = call("scroe", folder.path());
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.errors, HasSubstr("did you mean 'score'"));
  EXPECT_EQ(call("--help", folder.path()).exit_code, 0);
  EXPECT_EQ(call("--version", folder.path()).exit_code, 0);
  EXPECT_EQ(call("doctor", folder.path()).exit_code, 0);
}

}  // namespace
}  // namespace fracbench
