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

TEST(Validate, AnUnknownMethodIsBadInput) {
  const TemporaryFolder folder;
  const Answer answer = call("validate cdv", folder.path());
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.errors, HasSubstr("did you mean 'cvd'"));
}

}  // namespace
}  // namespace fracbench
