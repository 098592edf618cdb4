#include "harness/summary_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "harness/cell_summary_json.h"
#include "harness/record_store.h"
#include "harness/runner.h"
#include "harness/summaries.h"
#include "temporary_folder.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

class SummaryCacheTest : public testing::Test {
 protected:
  SummaryCacheTest() { run(); }

  RunResult run() { return run_suite(make_plan(suite, catalog), catalog, {.folder = folder}); }

  std::vector<fs::path> lines_files() const {
    if (!fs::is_directory(folder / "summaries")) return {};
    return {fs::directory_iterator(folder / "summaries"), fs::directory_iterator()};
  }

  std::string everything() const {
    std::string text;
    for (const CellSummary& cell : read_results(folder).cells) {
      text += to_json(cell).dump() + " " + cell.result_digest + "\n";
    }
    return text;
  }

  /// Leaves a mark in the summary that is kept of a record, so that one sees where it comes from.
  void mark(const fs::path& record) const {
    CellSummary summary = SummaryCache(folder).read(record);
    fs::remove_all(folder / "summaries");
    SummaryCache cache(folder);
    summary.reason = "as it was kept";
    cache.add(record, summary);
  }

  TemporaryFolder temporary;
  fs::path folder = temporary.path() / "results";
  ToyWorld world;
  Catalog catalog = world.catalog();
  Suite suite = toy_suite(catalog);
};

TEST_F(SummaryCacheTest, ARunLeavesASummaryOfEachOfItsRecords) {
  ASSERT_EQ(lines_files().size(), 1);
  std::ifstream stream(lines_files().front());
  const auto lines = std::count(std::istreambuf_iterator<char>(stream), {}, '\n');
  EXPECT_EQ(lines, 12);
  everything();
  EXPECT_EQ(lines_files().size(), 1) << "there was nothing to add";
}

TEST_F(SummaryCacheTest, SaysTheSameAsTheRecords) {
  const std::string kept = everything();
  fs::remove_all(folder / "summaries");
  EXPECT_EQ(everything(), kept);
}

TEST_F(SummaryCacheTest, IsUsedInPlaceOfARecordThatIsAsItWas) {
  const fs::path record = list_records(folder).front();
  mark(record);
  EXPECT_EQ(SummaryCache(folder).read(record).reason, "as it was kept");
}

TEST_F(SummaryCacheTest, ReadsARecordAnewThatWasWrittenAnew) {
  const fs::path record = list_records(folder).front();
  mark(record);
  const fs::path copy = folder / "copy";
  fs::copy_file(record, copy);
  fs::rename(copy, record);
  EXPECT_EQ(SummaryCache(folder).read(record).reason, "");
}

TEST_F(SummaryCacheTest, SeesAChangeWithinARecordOfTheSameSize) {
  const fs::path record = list_records(folder).front();
  std::fstream stream(record, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(static_cast<std::streamoff>(fs::file_size(record) / 2));
  stream << "damaged";
  stream.close();
  EXPECT_THROW(SummaryCache(folder).read(record), DataError);
  EXPECT_EQ(read_results(folder).unreadable.size(), 1);
}

TEST_F(SummaryCacheTest, SeesThatARecordIsGone) {
  const fs::path record = list_records(folder).front();
  fs::remove(record);
  EXPECT_THROW(SummaryCache(folder).read(record), DataError);
}

TEST_F(SummaryCacheTest, LinesThatAreCutOrDamagedSayNothing) {
  const std::string all = everything();
  const fs::path file = lines_files().front();
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t part = 0; part < 8; ++part) {
    const std::size_t at = part * text.size() / 8;
    std::string damaged = text;
    damaged[at] = damaged[at] == '1' ? '2' : '1';
    std::ofstream(file) << damaged;
    EXPECT_EQ(everything(), all) << "byte " << at;
    fs::resize_file(file, at);
    EXPECT_EQ(everything(), all) << "cut at " << at;
  }
}

TEST_F(SummaryCacheTest, DoesWithoutWhereNothingCanBeWritten) {
  const std::string all = everything();
  fs::remove_all(folder / "summaries");
  std::ofstream(folder / "summaries") << "a file in its place";
  EXPECT_EQ(everything(), all);
  EXPECT_EQ(run().found, 12);
}

TEST_F(SummaryCacheTest, SeveralMayWriteAtOnce) {
  const std::string all = everything();
  fs::remove_all(folder / "summaries");
  const auto records = list_records(folder);
  {
    SummaryCache one(folder), other(folder);
    for (const fs::path& record : records) {
      one.read(record);
      other.read(record);
    }
  }
  EXPECT_EQ(lines_files().size(), 2);
  EXPECT_EQ(everything(), all);
}

TEST_F(SummaryCacheTest, ARunTakesWhatIsKeptForDone) {
  const RunResult again = run();
  EXPECT_EQ(again.found, 12);
  EXPECT_EQ(lines_files().size(), 1);
}

}  // namespace
}  // namespace fracbench
