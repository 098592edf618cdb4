#include "methods/bem/validation/behaviour_cases.h"

#include <gtest/gtest.h>

#include "core/progress.h"
#include "geometry/measures.h"
#include "methods/bem/validation/breakage.h"

namespace fracbench::bem {
namespace {

Context context_with(Random& random, StageTimer& timer, Progress& progress) {
  return {.random = random, .timer = timer, .progress = progress, .threads = 2};
}

class BehaviourCases : public testing::TestWithParam<std::size_t> {};

TEST_P(BehaviourCases, AreAsExpected) {
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context = context_with(random, timer, progress);
  for (const Accuracy& row : behaviour_cases()[GetParam()].run(context)) {
    EXPECT_TRUE(row.pass()) << row.name << ": " << row.computed << " for " << row.expected
                            << " (error " << row.error() << ", allowed " << row.tolerance << ")";
  }
}

std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
  std::string name = behaviour_cases()[info.param].name;
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, BehaviourCases,
                         testing::Range<std::size_t>(0, behaviour_cases().size()), name_of);

TEST(Breakage, FillsTheBoxAndIsTheSameAgain) {
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context = context_with(random, timer, progress);
  const Breakage breakage;
  const Hit hit = test_hits().front();
  const std::vector<Piece> pieces = breakage.pieces(hit, 100, context);
  ASSERT_GT(pieces.size(), 1u);
  double sum = 0;
  for (const Piece& piece : pieces) sum += volume(piece.mesh);
  EXPECT_NEAR(sum / volume(test_box()), 1, 1e-12);
  const std::vector<Piece> again = breakage.pieces(hit, 100, context);
  ASSERT_EQ(again.size(), pieces.size());
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    EXPECT_EQ(again[n].mesh.vertices, pieces[n].mesh.vertices);
  }
}

}  // namespace
}  // namespace fracbench::bem
