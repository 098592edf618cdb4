#include "harness/summaries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "harness/data_file.h"
#include "harness/record_store.h"
#include "harness/runner.h"
#include "temporary_folder.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class SummariesTest : public testing::Test {
 protected:
  SummariesTest() { run(); }
  RunResult run() { return run_suite(make_plan(suite, catalog), catalog, {.folder = folder}); }
  fs::path some_record() const { return list_records(folder).front(); }

  TemporaryFolder temporary;
  fs::path folder = temporary.path() / "results";
  ToyWorld world;
  Catalog catalog = world.catalog();
  Suite suite = toy_suite(catalog);
};

TEST_F(SummariesTest, LeaveOutARecordWhoseValuesWereChanged) {
  DataTree tree = read_hdf5(some_record());
  std::vector<double> values = tree.reals("result/metrics/values");
  values.front() += 1;
  tree.put("result/metrics/values", values);
  std::ofstream(some_record(), std::ios::binary) << to_hdf5(tree);
  const Results results = read_results(folder);
  EXPECT_EQ(results.cells.size(), 11);
  EXPECT_THAT(results.unreadable, ElementsAre(HasSubstr("result_digest does not match")));
}

TEST_F(SummariesTest, LeaveOutARecordUnderTheNameOfAnother) {
  const auto files = list_records(folder);
  fs::copy_file(files[0], files[1], fs::copy_options::overwrite_existing);
  const Results results = read_results(folder);
  EXPECT_EQ(results.cells.size(), 11);
  EXPECT_THAT(results.unreadable, ElementsAre(HasSubstr("another cell")));
}

TEST_F(SummariesTest, AFolderWithAReportCanGetItsSuiteBack) {
  fs::create_directory(folder / "report");
  fs::remove(folder / "suite.json");
  EXPECT_EQ(run().found, 12);
  EXPECT_EQ(read_results(folder).cells.size(), 12);
}

}  // namespace
}  // namespace fracbench
