#include "reports/comparison_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace fracbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Comparison example() {
  Comparison comparison;
  comparison.verdict = "regression";
  comparison.exit_code = ExitCode::regression;
  comparison.suite = "quick";
  comparison.compared = 30;
  comparison.problems = {"1 cells are missing: pot/single/3/cvd"};
  comparison.status_regressions = {"pot/single/1/cvd: was ok, is crash: a < b & \"c\"\x01"};
  comparison.notes = {"a note"};
  GateResult good{.gate = {.metric = "fragment_count", .limit = 1.1, .relative = true},
                  .method = "cvd"};
  good.reason = "within";
  good.collisions = 30;
  good.change = 1.02;
  good.noise = 1.05;
  good.detectable = 1.2;
  good.p = 0.25;
  good.p_corrected = 0.5;
  GateResult bad = good;
  bad.gate.metric = "roughness";
  bad.outcome = GateOutcome::regression;
  GateResult refused{
      .gate = {.metric = "fragment_volume", .test = GateTest::kolmogorov_smirnov, .limit = 0.1},
      .method = "cvd",
      .outcome = GateOutcome::refused};
  GateResult reported{.gate = {.metric = "total_seconds", .limit = 1.5, .relative = true},
                      .method = "cvd",
                      .outcome = GateOutcome::reported};
  reported.change = 1.4;
  reported.change_low = 1.3;
  reported.change_high = 1.5;
  comparison.gates = {good, bad, refused, reported};
  return comparison;
}

TEST(ComparisonReport, TextBeginsWithWhatFailedAndEndsWithTheVerdict) {
  const std::string text = comparison_text(example());
  EXPECT_LT(text.find("cvd/roughness"), text.find("cvd/fragment_count"));
  EXPECT_THAT(text, HasSubstr("ratio 1.02 over 30 collisions (limit 1.1, noise 1.05, found with 95 "
                              "%: 1.2, p 0.25, corrected 0.5)"));
  EXPECT_THAT(text, HasSubstr("ratio 1.4 [1.3, 1.5]"));
  EXPECT_TRUE(text.ends_with("regression (30 cells compared, exit code 3)\n"));
}

TEST(ComparisonReport, JsonHasTheFixedNamesAndNullForWhatDoesNotExist) {
  const auto json = comparison_json(example());
  EXPECT_EQ(json["verdict"], "regression");
  EXPECT_EQ(json["exit_code"], 3);
  ASSERT_EQ(json["gates"].size(), 4u);
  EXPECT_EQ(json["gates"][0]["change"], 1.02);
  EXPECT_EQ(json["gates"][1]["outcome"], "regression");
  EXPECT_TRUE(json["gates"][2]["change"].is_null());
  EXPECT_EQ(json["gates"][3]["change_high"], 1.5);
}

TEST(ComparisonReport, JunitCountsFailuresErrorsAndSkippedAndEscapesTexts) {
  const std::string xml = comparison_junit(example());
  EXPECT_THAT(xml, AllOf(HasSubstr("tests=\"6\" failures=\"2\" errors=\"2\" skipped=\"1\""),
                         HasSubstr("a &lt; b &amp; &quot;c&quot;?"), Not(HasSubstr("a < b"))));
  Comparison good;
  good.verdict = "good";
  good.compared = 1;
  EXPECT_THAT(comparison_junit(good), HasSubstr("failures=\"0\" errors=\"0\""));
}

TEST(ComparisonReport, MarkdownHoldsATableOfAllGates) {
  const std::string text = comparison_markdown(example());
  EXPECT_THAT(text, AllOf(HasSubstr("## fracbench compare quick: regression"),
                          HasSubstr("| regression"), HasSubstr("cvd/fragment_volume (ks)"),
                          HasSubstr("1.4 [1.3, 1.5]"), HasSubstr("a \\< b")));
}

}  // namespace
}  // namespace fracbench
