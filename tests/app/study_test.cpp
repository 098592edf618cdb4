#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kSuite =
    "[study]\nside = 16\npatterns = 2\nleast_sites = 3\nmost_sites = 4\nepochs = 3\n"
    "[scale.paper]\nsummary = \"larger\"\nset = [\"study.epochs=7\"]\n";

class Study : public ::testing::Test {
 protected:
  Study() { folder_.write("study.toml", kSuite); }
  Answer run(const std::string& more = "") {
    return call("run study.toml --out results " + more, folder_.path());
  }
  TemporaryFolder folder_;
};

TEST_F(Study, IsMadeOnceAndReportedWithPictures) {
  const Answer dry = run("--dry-run");
  EXPECT_EQ(dry.exit_code, 0) << dry.errors;
  EXPECT_THAT(dry.output, AllOf(HasSubstr("x 3 epochs x 2 patterns"), HasSubstr("--scale paper"),
                                HasSubstr("x 7 epochs x 2 patterns")));
  EXPECT_FALSE(fs::exists(folder_.path() / "results"));

  EXPECT_EQ(run("--json").json()["found"], false);
  const std::string made = folder_.read("results/study.data");
  EXPECT_EQ(run("--json").json()["found"], true);
  EXPECT_EQ(folder_.read("results/study.data"), made);

  const Answer report = call("report results", folder_.path());
  ASSERT_EQ(report.exit_code, 0) << report.errors;
  EXPECT_THAT(folder_.read("results/report/report.md"),
              AllOf(HasSubstr("| labels"), HasSubstr("representation_lines.png")));
  EXPECT_THAT(
      folder_.read("results/report/index.html"),
      AllOf(HasSubstr("src=\"representation_distance.png\""), HasSubstr("study"),
            ::testing::Not(HasSubstr("#viewer")), ::testing::Not(HasSubstr("id=\"cells\""))));
  for (const char* name : {"labels", "lines", "distance"}) {
    const std::string png = "results/report/representation_" + std::string(name) + ".png";
    EXPECT_EQ(folder_.read(png).substr(1, 3), "PNG");
  }
}

TEST_F(Study, ThatIsDamagedIsLeftOutOfReportsAndMadeAgain) {
  ASSERT_EQ(run().exit_code, 0);
  const fs::path file = folder_.path() / "results/study.data";
  const std::string made = folder_.read("results/study.data");
  fs::resize_file(file, fs::file_size(file) / 2);
  const Answer report = call("report results", folder_.path());
  EXPECT_EQ(report.exit_code, 4);
  EXPECT_THAT(report.errors, AllOf(HasSubstr("study.data"), HasSubstr("run")));
  const Answer again = run();
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.errors, HasSubstr("made again"));
  EXPECT_EQ(folder_.read("results/study.data"), made);
}

TEST_F(Study, WithOtherSettingsNeedsAnotherFolder) {
  ASSERT_EQ(run().exit_code, 0);
  const Answer other = run("--set study.epochs=4");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.errors, HasSubstr("study.epochs: 3 there, 4 here"));
}

TEST_F(Study, BadSuitesAreRefusedWithTheWayOut) {
  const auto message = [&](const std::string& suite, const std::string& more = "") {
    folder_.write("bad.toml", suite);
    const Answer answer = call("run bad.toml " + more, folder_.path());
    EXPECT_EQ(answer.exit_code, 2);
    return answer.errors;
  };
  EXPECT_THAT(message("[study]\nepoch = 3\n"),
              AllOf(HasSubstr("bad.toml:2"), HasSubstr("did you mean 'epochs'")));
  EXPECT_THAT(message("[study]\nside = 48\nepochs = 1\n"), HasSubstr("power of two"));
  EXPECT_THAT(message("shapes = [\"cube\"]\n[study]\n"), HasSubstr("another suite"));
  EXPECT_THAT(message("[study]\n", "--set study.kind=other"), HasSubstr("representations"));
  const Answer prepare = call("prepare study.toml", folder_.path());
  EXPECT_EQ(prepare.exit_code, 2);
  EXPECT_THAT(prepare.errors, HasSubstr("fracbench run study.toml"));
}

}  // namespace
}  // namespace fracbench
