#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.h"

namespace fracbench {
namespace {

using ::testing::HasSubstr;

TEST(Validate, AMethodWithoutCasesIsNotMeasured) {
  const TemporaryFolder folder;
  const Answer answer = call("validate cvd", folder.path());
  EXPECT_EQ(answer.exit_code, 4);
  EXPECT_THAT(answer.errors, HasSubstr("method 'cvd' has no validation cases"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "results"));
  const Answer json = call("validate cvd --json", folder.path());
  EXPECT_EQ(json.exit_code, 4);
  EXPECT_EQ(json.json(), nlohmann::json::array());
}

TEST(Validate, GivesTheTableOfTheCasesThatWereAskedFor) {
  const TemporaryFolder folder;
  const Answer answer = call("validate bem hertz --json --out table", folder.path());
  ASSERT_EQ(answer.exit_code, 0) << answer.errors;
  const auto rows = answer.json();
  ASSERT_FALSE(rows.empty());
  for (const auto& row : rows) {
    EXPECT_EQ(row["group"], "hertz");
    EXPECT_EQ(row["pass"], true);
    EXPECT_LE(row["error"], row["tolerance"]);
    EXPECT_THAT(folder.read("table/accuracy.md"), HasSubstr(row["case"].get<std::string>()));
  }
  EXPECT_THAT(folder.read("table/accuracy.csv"), HasSubstr("case,reference,computed"));
  EXPECT_EQ(call("validate bem hertz", folder.path()).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "results"));
  const Answer wrong = call("validate bem hetrz", folder.path());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("did you mean 'hertz'"));
}

TEST(Validate, AnUnknownMethodIsBadInput) {
  const TemporaryFolder folder;
  const Answer answer = call("validate cdv", folder.path());
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.errors, HasSubstr("did you mean 'cvd'"));
}

}  // namespace
}  // namespace fracbench
