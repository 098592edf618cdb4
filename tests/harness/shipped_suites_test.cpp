#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "core/error.h"
#include "harness/record_store.h"
#include "harness/runner.h"
#include "harness/suite_files.h"
#include "harness/suite_overrides.h"
#include "harness/suite_reader.h"
#include "harness/summaries.h"
#include "source_folder.h"
#include "temporary_folder.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

TEST(ShippedSuitesTest, CanBeReadAndSayWhatTheyAreFor) {
  const Catalog catalog = built_in_catalog();
  std::size_t count = 0;
  for (const fs::directory_entry& item :
       fs::directory_iterator(fs::path(FRACBENCH_SOURCE_DIR) / "scenarios" / "suites")) {
    const Suite suite = read_suite(item.path(), catalog);
    EXPECT_EQ(suite.name, item.path().stem().string());
    EXPECT_FALSE(suite.summary.empty()) << item.path();
    for (const SuiteScale& scale : suite.scales) {
      const Suite other = at_scale(suite, scale.name, catalog);
      EXPECT_EQ(other.name, suite.name + "-" + scale.name);
      EXPECT_FALSE(scale.summary.empty()) << item.path();
    }
    ++count;
  }
  EXPECT_GE(count, 11);
}

TEST(ShippedSuitesTest, EveryItemOfThePaperHasASuiteOfItsNameAtTwoScales) {
  const Catalog catalog = built_in_catalog();
  for (const char* item : {"table-1", "table-2", "figure-8", "figure-9", "figure-10", "figure-11",
                           "supplement-1", "supplement-2", "supplement-3", "supplement-4",
                           "supplement-5", "supplement-6", "supplement-7", "supplement-8",
                           "supplement-10", "supplement-11", "supplement-12", "supplement-13"}) {
    const Suite suite = read_suite(find_suite_file(item), catalog);
    EXPECT_NO_THROW(make_plan(suite, catalog)) << item;
    ASSERT_EQ(suite.scales.size(), 1u) << item;
    EXPECT_EQ(suite.scales[0].name, "paper");
  }
}

TEST(ShippedSuitesTest, AScaleThatIsNotThereIsRefusedWithTheNearest) {
  const Catalog catalog = built_in_catalog();
  const Suite suite = read_suite(find_suite_file("figure-10"), catalog);
  try {
    at_scale(suite, "papr", catalog);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'paper'"), std::string::npos);
  }
}

TEST(ShippedSuitesTest, QuickUsesNothingThatIsNotThere) {
  const Catalog catalog = built_in_catalog();
  const Plan plan = make_plan(read_suite(find_suite_file("quick"), catalog), catalog);
  EXPECT_EQ(plan.cells.size(), plan.suite_cells);
}

/// The whole way with what is built in: real scenes, methods and metrics.
class QuickSuiteTest : public testing::Test {
 protected:
  std::map<std::string, std::string> run(const char* name, int jobs) {
    const RunResult result = run_suite(plan, catalog, {.folder = base / name, .jobs = jobs});
    EXPECT_TRUE(result.complete());
    std::map<std::string, std::string> digests;
    const RecordStore store(base / name);
    for (const Cell& cell : plan.cells) digests[cell.key] = result_digest(store.read(cell.key));
    return digests;
  }

  static Suite suite(const Catalog& catalog) {
    Suite quick = read_suite(find_suite_file("quick"), catalog);
    return with_override(quick, "scenario.single.count=1", catalog);
  }

  TemporaryFolder temporary;
  const fs::path& base = temporary.path();
  Catalog catalog = built_in_catalog();
  Plan plan = make_plan(suite(catalog), catalog, {.shapes = {"cube", "mug", "bar"}});
};

TEST_F(QuickSuiteTest, GivesSoundRecordsThatAreTheSameForAnyNumberOfJobs) {
  EXPECT_EQ(run("one", 1), run("two", 2));
  std::size_t broken = 0;
  for (const CellSummary& cell : read_summaries(base / "two")) {
    const std::string where = cell.shape + " " + cell.scenario + " " + cell.label;
    EXPECT_TRUE(cell.status == CellStatus::ok || cell.status == CellStatus::unbroken)
        << where << ": " << cell.reason;
    double sum = 0;
    for (const StageTime& stage : cell.stages) sum += stage.seconds;
    EXPECT_NEAR(sum / cell.total_seconds, 1, 0.02) << where;
    for (const MetricValue& value : cell.values) {
      EXPECT_TRUE(std::isfinite(value.value)) << where << " " << value.name;
      if (value.name == "volume_ratio" && cell.label == "cvd") {
        EXPECT_NEAR(value.value, 1, 1e-9) << where;
      }
    }
    broken += cell.status == CellStatus::ok;
  }
  EXPECT_GE(broken, 2);
  for (const Cell& cell : plan.cells) {
    for (const Replacement& r :
         RecordStore(base / "one").read(cell.key).outcome.scene.replacements) {
      EXPECT_LE(r.momentum_error, 1e-6);
      EXPECT_LE(r.angular_momentum_error, 1e-6);
      EXPECT_LE(r.energy_ratio, 1 + 1e-6);
    }
  }
}

}  // namespace
}  // namespace fracbench
