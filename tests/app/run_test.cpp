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

TEST_F(Run, AnswersADryRunAsJsonToo) {
  const Answer before = call("run small.toml --out results --dry-run --json", folder_.path());
  EXPECT_EQ(before.json()["cells"], 2);
  EXPECT_EQ(before.json()["unknown"], 2);
  ASSERT_EQ(run().exit_code, 0);
  EXPECT_EQ(run("--dry-run").json()["found"], 2);
}

TEST_F(Run, ADryRunTellsWhatIsLearnedFrom) {
  const Answer all = call("run quick --out results --dry-run --json", folder_.path());
  EXPECT_EQ(all.json()["learning"]["cells"], 20);
  ASSERT_EQ(all.json()["training"].size(), 1u);
  EXPECT_EQ(all.json()["training"][0]["method"], "deepfracture");
  EXPECT_GT(all.json()["training"][0]["seconds"], 1);
  EXPECT_THAT(
      call("run quick --out results --methods nearest-pattern --dry-run", folder_.path()).output,
      HasSubstr("learning data, made first: 20 cells"));
  const Answer none = call("run quick --methods cvd --dry-run --json", folder_.path());
  EXPECT_FALSE(none.json().contains("learning"));
}

TEST_F(Run, KnowsItsResultsAgainFromAnotherFolder) {
  ASSERT_EQ(call("fracture cvd cube --ball 3,0,0,-60,0,0 --set sites=1 --out rock", folder_.path())
                .exit_code,
            0);
  fs::copy_file(folder_.path() / "rock/fragment_000.obj", folder_.path() / "rock.obj");
  std::string suite = kSuite;
  suite.replace(suite.find("\"cube\""), 6, "\"rock.obj\"");
  suite.replace(suite.find("resolution = 4\n"), 15, "");
  folder_.write("rock.toml", suite);
  ASSERT_EQ(call("run rock.toml --out results", folder_.path()).exit_code, 0);
  fs::create_directory(folder_.path() / "below");
  const Answer again = call("run ../rock.toml --out ../results --json", folder_.path() / "below");
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(again.json()["found"], 2);
}

TEST_F(Run, RefusesASuiteThatIsEmptyOrCalledAfterAPath) {
  folder_.write("empty.toml", "");
  EXPECT_THAT(call("run empty.toml", folder_.path()).errors, HasSubstr("has no shape"));
  folder_.write("path.toml", std::string("name = \"../elsewhere\"\n") + kSuite);
  const Answer path = call("run path.toml", folder_.path());
  EXPECT_EQ(path.exit_code, 2);
  EXPECT_THAT(path.errors, HasSubstr("without slashes"));
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

TEST(Usage, OutputThatCannotBeWrittenIsNoSuccess) {
  const TemporaryFolder folder;
  for (const char* what : {"list metrics", "list metrics --json"}) {
    const Answer answer = call_with_output(what, folder.path(), "/dev/full");
    EXPECT_EQ(answer.exit_code, 2) << what;
    EXPECT_THAT(answer.errors, HasSubstr("standard output")) << what;
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
