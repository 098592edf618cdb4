#include "harness/agreement_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.h"
#include "harness/reference_agreement.h"
#include "harness/runner.h"
#include "harness/summaries.h"
#include "temporary_folder.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kMark = -7;  // no index of any pair

class AgreementCacheTest : public testing::Test {
 protected:
  AgreementCacheTest() {
    run_suite(make_plan(toy_suite(catalog), catalog), catalog, {.folder = folder});
    cells = read_summaries(folder);
    options.samples = {.resolution = 16, .surfaces = {.fracture_surface = 50, .fragment = 20}};
  }

  std::vector<FractureAgreement> agreements() const {
    std::vector<FractureAgreement> result;
    for (const ReferenceAgreement& pair : agreement_with_reference(folder, cells, options)) {
      result.push_back(pair.agreement);
    }
    return result;
  }

  std::size_t marked() const {
    return static_cast<std::size_t>(std::ranges::count(
        agreements(), kMark,
        [](const FractureAgreement& agreement) { return agreement.partition.adjusted_rand; }));
  }

  std::vector<Json> lines() const {
    std::vector<Json> all;
    KeptLines(kept).read([&](const Json& line) { all.push_back(line); });
    return all;
  }

  void put(const std::vector<Json>& all) const {
    fs::remove_all(kept);
    std::vector<std::string> texts;
    for (const Json& line : all) texts.push_back(line.dump());
    KeptLines(kept).append(texts);
  }

  /// Leaves a mark in what is kept, so that one sees where it comes from.
  void mark() const {
    std::vector<Json> all = lines();
    for (Json& line : all) line["agreement"]["partition"][0] = kMark;
    put(all);
  }

  TemporaryFolder temporary;
  fs::path folder = temporary.path() / "results";
  fs::path kept = folder / "agreements";
  ToyWorld world;
  Catalog catalog = world.catalog();
  std::vector<CellSummary> cells;
  AgreementOptions options{.reference = "halves", .samples = {}};
};

TEST_F(AgreementCacheTest, GivesBackAllBitsWithoutTheRecords) {
  const auto computed = agreements();
  ASSERT_EQ(computed.size(), 12u);
  EXPECT_EQ(lines().size(), 12u);
  fs::remove_all(folder / "records");
  EXPECT_EQ(agreements(), computed);
  EXPECT_EQ(lines().size(), 12u) << "there was nothing to add";
  fs::remove_all(kept);
  EXPECT_THROW(agreements(), DataError);
}

TEST_F(AgreementCacheTest, OnlyWhatIsMissingIsComputed) {
  agreements();
  std::vector<Json> all = lines();
  all.resize(5);
  put(all);
  mark();
  EXPECT_EQ(marked(), 5u);
  EXPECT_EQ(lines().size(), 12u);
}

TEST_F(AgreementCacheTest, OtherSamplesAreComputedAnew) {
  agreements();
  mark();
  EXPECT_EQ(marked(), 12u);
  const FractureSamples before = options.samples;
  options.samples.resolution = 20;
  EXPECT_EQ(marked(), 0u);
  options.samples = before;
  options.samples.surfaces.fracture_surface = 60;
  EXPECT_EQ(marked(), 0u);
  options.samples = before;
  options.samples.surfaces.fragment = 30;
  EXPECT_EQ(marked(), 0u);
}

TEST_F(AgreementCacheTest, OtherResultsAreComparedAnew) {
  agreements();
  mark();
  ASSERT_EQ(cells[0].label, "halves");
  const std::string digest = cells[0].result_digest;
  EXPECT_EQ(digest.size(), 64u);
  cells[0].result_digest = std::string(64, '0');
  // The other method under this impact, and two impacts of the reference in their ring.
  EXPECT_EQ(marked(), 9u);
  cells[0].result_digest = digest;
  EXPECT_EQ(marked(), 12u);
  ++cells[1].seed;
  EXPECT_EQ(marked(), 11u);
}

TEST_F(AgreementCacheTest, LinesThatAreCutOrDamagedSayNothing) {
  const auto computed = agreements();
  const fs::path file = *fs::directory_iterator(kept);
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t part = 0; part < 8; ++part) {
    const std::size_t at = part * text.size() / 8;
    std::string damaged = text;
    damaged[at] = damaged[at] == '1' ? '2' : '1';
    fs::remove_all(kept);
    fs::create_directory(kept);
    std::ofstream(file) << damaged;
    EXPECT_EQ(agreements(), computed) << "byte " << at;
    EXPECT_GE(lines().size(), 12u) << "what was damaged is there again";
    fs::remove_all(kept);
    fs::create_directory(kept);
    std::ofstream(file) << text.substr(0, at);
    EXPECT_EQ(agreements(), computed) << "cut at " << at;
  }
}

TEST_F(AgreementCacheTest, NumbersThatNoTextHoldsAreNotKept) {
  AgreementCache cache(folder);
  const std::vector<std::string> keys{"one", "two"};
  std::vector<FractureAgreement> two(2);
  two[0].fragment_chamfer = std::numeric_limits<double>::quiet_NaN();
  cache.keep(keys, two);
  EXPECT_EQ(AgreementCache(folder).find("one"), std::nullopt);
  EXPECT_EQ(AgreementCache(folder).find("two"), two[1]);
}

TEST_F(AgreementCacheTest, DoesWithoutWhereNothingCanBeWritten) {
  const auto computed = agreements();
  fs::remove_all(kept);
  std::ofstream(kept) << "a file in its place";
  EXPECT_EQ(agreements(), computed);
  EXPECT_EQ(agreements(), computed);
}

TEST_F(AgreementCacheTest, SeveralMayWriteAtOnce) {
  std::vector<std::vector<FractureAgreement>> found(3);
  {
    std::vector<std::jthread> writers;
    for (auto& result : found) writers.emplace_back([&] { result = agreements(); });
  }
  EXPECT_EQ(found[1], found[0]);
  EXPECT_EQ(found[2], found[0]);
  fs::remove_all(folder / "records");
  EXPECT_EQ(agreements(), found[0]);
}

TEST_F(AgreementCacheTest, AreTheSameForAnyNumberOfThreads) {
  options.threads = 1;
  const auto computed = agreements();
  fs::remove_all(kept);
  options.threads = 2;
  EXPECT_EQ(agreements(), computed);
}

}  // namespace
}  // namespace fracbench
