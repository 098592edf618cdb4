#include "harness/accept_baseline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/error.h"
#include "harness/compare.h"
#include "harness/record_store.h"
#include "harness/runner.h"
#include "tests/harness/temporary_folder.h"
#include "tests/harness/toy_catalog.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class AcceptBaseline : public ::testing::Test {
 protected:
  AcceptBaseline() {
    run_suite(make_plan(toy_suite(catalog_), catalog_), catalog_, {.folder = candidate_});
  }

  std::string complaint(const std::string& why = "why") {
    try {
      accept(why);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  Acceptance accept(const std::string& why) {
    return accept_baseline(baseline_, candidate_,
                           {.when = "", .who = "me", .why = why, .suite = ""});
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }

  TemporaryFolder folder_;
  fs::path candidate_ = folder_.path() / "candidate";
  fs::path baseline_ = folder_.path() / "baseline";
  ToyWorld world_;
  Catalog catalog_ = world_.catalog();
};

TEST_F(AcceptBaseline, MakesTheFirstBaselineAndThenReplacesItKeepingAllNotes) {
  const Acceptance first = accept("the first");
  EXPECT_EQ(first.cells, 12u);
  EXPECT_FALSE(first.when.empty());
  EXPECT_EQ(compare_folders(baseline_, candidate_, default_gates()).verdict, "good");
  std::ofstream(baseline_ / "records" / "old.h5") << "of the old baseline";
  const Acceptance second = accept("a second");
  EXPECT_EQ(read_acceptances(baseline_), (std::vector<Acceptance>{first, second}));
  EXPECT_FALSE(fs::exists(baseline_ / "records" / "old.h5"));
  EXPECT_EQ(list_records(baseline_).size(), 12u);
  EXPECT_EQ(entries(), 2u);  // nothing is left beside
}

TEST_F(AcceptBaseline, ASummaryFileComparesLikeTheFolderItStandsFor) {
  const fs::path folder = baseline_;
  accept("the folder");
  baseline_ += ".json";
  const Acceptance first = accept("the summary");
  const Acceptance second = accept("again");
  EXPECT_EQ(read_acceptances(baseline_), (std::vector<Acceptance>{first, second}));
  const Comparison whole = compare_folders(folder, candidate_, default_gates());
  const Comparison summary = compare_folders(baseline_, candidate_, default_gates());
  EXPECT_EQ(summary.verdict, "good");
  EXPECT_EQ(summary.compared, 12u);
  ASSERT_EQ(summary.gates.size(), whole.gates.size());
  for (std::size_t g = 0; g < whole.gates.size(); ++g) {
    EXPECT_EQ(summary.gates[g].baseline, whole.gates[g].baseline);
    EXPECT_EQ(summary.gates[g].noise, whole.gates[g].noise);
  }
}

TEST_F(AcceptBaseline, ASummaryFileThatWasTamperedWithIsRefused) {
  baseline_ += ".json";
  accept("why");
  std::stringstream text;
  text << std::ifstream(baseline_).rdbuf();
  const std::string good = text.str();
  const auto error_with = [&](const std::string& bytes) -> std::string {
    std::ofstream(baseline_) << bytes;
    try {
      compare_folders(baseline_, candidate_, default_gates());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  std::string other = good;
  other[other.rfind("\"breaks\":") + 9] = '7';
  EXPECT_THAT(error_with(other), HasSubstr("is damaged"));
  EXPECT_THAT(error_with(good.substr(0, good.size() / 2)), HasSubstr("is no summary"));
  other = good;
  other[other.find("\"version\": 1") + 11] = '2';
  EXPECT_THAT(error_with(other), HasSubstr("version 2"));
  EXPECT_EQ(error_with(good), "");
}

TEST_F(AcceptBaseline, ABaselineIsAResultsFolderThatCanBeMeasuredFurther) {
  accept("why");
  const RunResult result =
      run_suite(make_plan(toy_suite(catalog_), catalog_), catalog_, {.folder = baseline_});
  EXPECT_EQ(result.found, 12u);
}

TEST_F(AcceptBaseline, AnIncompleteOrDamagedCandidateIsRefusedAndTheBaselineStays) {
  accept("why");
  const fs::path record = list_records(candidate_)[0];
  fs::resize_file(record, fs::file_size(record) / 2);
  EXPECT_THAT(complaint(), HasSubstr("damaged"));
  fs::remove(record);
  EXPECT_THAT(complaint(), HasSubstr("11 of the suite's 12 cells"));
  EXPECT_EQ(list_records(baseline_).size(), 12u);
  EXPECT_EQ(read_acceptances(baseline_).size(), 1u);
  EXPECT_EQ(entries(), 2u);
}

TEST_F(AcceptBaseline, NeedsAReason) { EXPECT_THAT(complaint(""), HasSubstr("--why")); }

TEST_F(AcceptBaseline, OverwritesNothingThatIsNoBaseline) {
  fs::create_directory(baseline_);
  std::ofstream(baseline_ / "thesis.tex") << "precious";
  EXPECT_THAT(complaint(), HasSubstr("is not overwritten"));
  EXPECT_TRUE(fs::exists(baseline_ / "thesis.tex"));
  baseline_ = candidate_;
  EXPECT_THAT(complaint(), HasSubstr("the baseline itself"));
}

TEST_F(AcceptBaseline, ADamagedHistoryIsNotSilentlyLost) {
  accept("why");
  std::ofstream(baseline_ / "accepted.json") << "[{";
  EXPECT_THAT(complaint(), HasSubstr("accepted.json"));
}

}  // namespace
}  // namespace fracbench
