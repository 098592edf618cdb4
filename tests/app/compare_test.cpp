#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kSuite =
    "[[shape]]\nname = \"cube\"\nresolution = 4\n"
    "[[scenario]]\nfamily = \"single\"\ncount = 2\nspeed_min = 90\nframes = 20\n"
    "[[method]]\nname = \"cvd\"\nsites = 5\n";

class CompareCommand : public ::testing::Test {
 protected:
  CompareCommand() {
    folder_.write("small.toml", kSuite);
    run("old");
  }
  void run(const std::string& out, const std::string& more = "") {
    const Answer answer = call("run small.toml --out " + out + " " + more, folder_.path());
    ASSERT_EQ(answer.exit_code, 0) << answer.errors;
  }
  Answer compare(const std::string& arguments) {
    return call("compare " + arguments, folder_.path());
  }
  TemporaryFolder folder_;
};

TEST_F(CompareCommand, ARerunIsGoodInAllFormsOfOutput) {
  run("new");
  const Answer text = compare("old new --junit verdict.xml --markdown verdict.md");
  EXPECT_EQ(text.exit_code, 0) << text.output << text.errors;
  EXPECT_THAT(text.output, HasSubstr("good (2 cells compared, exit code 0)"));
  EXPECT_THAT(folder_.read("verdict.xml"), HasSubstr("failures=\"0\" errors=\"0\""));
  EXPECT_THAT(folder_.read("verdict.md"), HasSubstr("small: good"));
  const Answer json = compare("old new --json");
  EXPECT_EQ(json.json()["verdict"], "good");
  EXPECT_EQ(json.json()["exit_code"], 0);
  EXPECT_GE(json.json()["gates"].size(), 6u);
}

TEST_F(CompareCommand, EachWayToFailHasItsExitCode) {
  const Answer missing = compare("nowhere old");
  EXPECT_EQ(missing.exit_code, 5);
  EXPECT_THAT(missing.output, AllOf(HasSubstr("there is no baseline"), HasSubstr("--accept")));
  EXPECT_EQ(compare("old nowhere").exit_code, 2);

  run("other", "--set seed=9");
  const Answer unequal = compare("old other");
  EXPECT_EQ(unequal.exit_code, 5);
  EXPECT_THAT(unequal.output, HasSubstr("seed: 1 there, 9 here"));

  run("part");
  fs::remove(fs::directory_iterator(folder_.path() / "part/records")->path());
  const Answer part = compare("old part --json");
  EXPECT_EQ(part.exit_code, 4);
  EXPECT_EQ(part.json()["verdict"], "not-measured");

  folder_.write("gates.toml", "[[gate]]\nmetric = \"total_seconds\"\nfacter = 1.1\n");
  const Answer mistake = compare("old old --gates gates.toml");
  EXPECT_EQ(mistake.exit_code, 2);
  EXPECT_THAT(mistake.errors, HasSubstr("did you mean 'factor'"));
}

TEST_F(CompareCommand, AMethodThatNowBreaksOtherwiseIsARegression) {
  const std::string many = "--set scenario.single.count=13";
  run("base", many);
  run("now", many + " --set method.cvd.sites=25");
  // As if the same suite had been measured by a method that was edited.
  fs::copy_file(folder_.path() / "base/suite.json", folder_.path() / "now/suite.json",
                fs::copy_options::overwrite_existing);
  const Answer answer = compare("base now --json");
  EXPECT_EQ(answer.exit_code, 3) << answer.output << answer.errors;
  EXPECT_EQ(answer.json()["verdict"], "regression");
  const auto gate = answer.json()["gates"][0];
  EXPECT_EQ(gate["metric"], "fragment_count");
  EXPECT_EQ(gate["outcome"], "regression");
  EXPECT_GT(gate["change"], 2);
}

TEST_F(CompareCommand, AcceptingMakesTheNewBaselineWithANote) {
  EXPECT_EQ(compare("base old --accept").exit_code, 2);
  EXPECT_EQ(compare("base old --why forgotten").exit_code, 2);
  const Answer first = compare("base old --accept --who me --why 'the first one'");
  EXPECT_EQ(first.exit_code, 0) << first.errors;
  EXPECT_THAT(folder_.read("base/accepted.json"),
              AllOf(HasSubstr("the first one"), HasSubstr("me")));
  EXPECT_EQ(compare("base old").exit_code, 0);
  run("other", "--set seed=9");
  EXPECT_EQ(compare("base other --json --accept --why seeds").json()["accepted"]["why"], "seeds");
  EXPECT_EQ(compare("base other").exit_code, 0);
  EXPECT_EQ(compare("base old").exit_code, 5);
}

}  // namespace
}  // namespace fracbench
