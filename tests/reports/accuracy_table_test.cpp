#include "reports/accuracy_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "reports/csv.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

ValidationRun example() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {.rows = {{.group = "penny",
                    .accuracy = {.name = "K_I",
                                 .reference = "closed form",
                                 .expected = 2,
                                 .computed = 2.02,
                                 .tolerance = 0.02,
                                 .unit = "Pa sqrt(m)"}},
                   {.group = "penny",
                    .accuracy = {.name = "K_II",
                                 .reference = "symmetry",
                                 .expected = 0,
                                 .computed = 0.5,
                                 .tolerance = 0.1}},
                   {.group = "beam",
                    .accuracy = {.name = "a beam",
                                 .reference = "",
                                 .expected = nan,
                                 .computed = nan,
                                 .tolerance = nan},
                    .failure = "the mesh, \"it\" | is open"}},
          .cases = 3,
          .done = 2};
}

TEST(AccuracyTable, HoldsARowForEachValueAndReadsBackFromCsv) {
  const Table table = accuracy_table(example(), "toy");
  const auto lines = parse_csv(to_csv(table), "accuracy.csv");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_THAT(lines[0],
              ElementsAre("case", "reference", "computed", "error", "tolerance", "pass", "source"));
  EXPECT_THAT(lines[1], ElementsAre("penny: K_I [Pa sqrt(m)]", "2", "2.02", testing::_, "0.02",
                                    "yes", "closed form"));
  EXPECT_NEAR(std::stod(lines[1][3]), 0.01, 1e-12);
  EXPECT_THAT(lines[2], ElementsAre("penny: K_II", "0", "0.5", "0.5", "0.1", "no", "symmetry"));
  EXPECT_THAT(lines[3], ElementsAre("beam: a beam", "", "", "", "", "no",
                                    "failed: the mesh, \"it\" | is open"));
}

TEST(AccuracyTable, SaysInJsonWhatScriptsRelyOnAndNullForWhatIsNoNumber) {
  const auto json = nlohmann::json::parse(accuracy_json(example()).dump());
  ASSERT_EQ(json.size(), 3u);
  EXPECT_EQ(json[0]["case"], "K_I");
  EXPECT_EQ(json[0]["reference"], 2);
  EXPECT_EQ(json[0]["computed"], 2.02);
  EXPECT_EQ(json[0]["tolerance"], 0.02);
  EXPECT_EQ(json[0]["pass"], true);
  EXPECT_EQ(json[1]["pass"], false);
  EXPECT_EQ(json[1]["error"], 0.5);
  EXPECT_TRUE(json[2]["computed"].is_null());
  EXPECT_TRUE(json[2]["error"].is_null());
  EXPECT_THAT(json[2]["reason"].get<std::string>(), HasSubstr("is open"));
}

TEST(AccuracyTable, IsWrittenAsMarkdownAndCsv) {
  std::string name = (fs::temp_directory_path() / "fracbench-test-XXXXXX").string();
  ASSERT_NE(mkdtemp(name.data()), nullptr);
  write_accuracy(example(), "toy", fs::path(name) / "new" / "folder");
  std::ifstream file(fs::path(name) / "new" / "folder" / "accuracy.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(text, AllOf(HasSubstr("# Accuracy of method toy"), HasSubstr("2 of 3 cases"),
                          HasSubstr("1 of 3 values"), HasSubstr("\\| is open")));
  EXPECT_TRUE(fs::exists(fs::path(name) / "new" / "folder" / "accuracy.csv"));
  EXPECT_THROW(write_accuracy(example(), "toy", fs::path(name) / "new/folder/accuracy.md"),
               InputError);
  fs::remove_all(name);
}

}  // namespace
}  // namespace fracbench
