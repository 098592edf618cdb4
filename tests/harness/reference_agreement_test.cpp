#include "harness/reference_agreement.h"

#include <gtest/gtest.h>

#include <map>

#include "harness/runner.h"
#include "harness/summaries.h"
#include "temporary_folder.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

class ReferenceAgreementTest : public testing::Test {
 protected:
  ReferenceAgreementTest() {
    run_suite(make_plan(toy_suite(catalog), catalog), catalog, {.folder = folder});
    cells = read_summaries(folder);
  }

  TemporaryFolder temporary;
  std::filesystem::path folder = temporary.path() / "results";
  ToyWorld world;
  Catalog catalog = world.catalog();
  std::vector<CellSummary> cells;
};

TEST_F(ReferenceAgreementTest,
       ComparesEveryBrokenCellUnderTheSameImpactAndTheReferenceWithItsNext) {
  const auto pairs = agreement_with_reference(folder, cells, {.reference = "halves"});
  std::map<std::string, int> floors, others;
  for (const ReferenceAgreement& pair : pairs) {
    ++(pair.other_impact ? floors : others)[pair.shape];
    EXPECT_EQ(pair.label, pair.other_impact ? "halves" : "halves-wide");
    EXPECT_LE(pair.agreement.partition.adjusted_rand, 1);
    EXPECT_LT(pair.agreement.partition.adjusted_rand, 0.999);  // planes drawn from other seeds
  }
  EXPECT_EQ(floors, (std::map<std::string, int>{{"box", 3}, {"slab", 3}}));
  EXPECT_EQ(others, floors);
}

TEST_F(ReferenceAgreementTest, TheSameFragmentsAgreeInFull) {
  // The reference under a second name: the same records.
  std::vector<CellSummary> twice;
  for (const CellSummary& cell : cells) {
    if (cell.label != "halves") continue;
    twice.push_back(cell);
    twice.push_back(cell);
    twice.back().label = "again";
  }
  int compared = 0;
  for (const ReferenceAgreement& pair :
       agreement_with_reference(folder, twice, {.reference = "halves"})) {
    if (pair.other_impact) continue;
    EXPECT_EQ(pair.agreement.partition.adjusted_rand, 1);
    ++compared;
  }
  EXPECT_EQ(compared, 6);
}

TEST_F(ReferenceAgreementTest, WithoutTheReferenceThereIsNothingToCompareWith) {
  EXPECT_TRUE(agreement_with_reference(folder, cells).empty());
}

}  // namespace
}  // namespace fracbench
