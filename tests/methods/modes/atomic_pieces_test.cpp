#include "methods/modes/atomic_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "geometry/measures.h"
#include "tests/methods/cvd/bodies.h"
#include "tests/methods/modes/made_up_modes.h"

namespace fracbench {
namespace {

using namespace modes;

AtomicPieces cut(const test::Bar& bar, const MergeOptions& merge) {
  test::Surroundings surroundings;
  Context context = surroundings.context();
  return atomic_pieces(bar.target.mesh, bar.tets, bar.found, merge, context);
}

TEST(AtomicPieces, AreJoinedInEveryMode) {
  const TetMesh tets = test::tet_block({6, 2, 2}, Vec3(0, 0, 0), Vec3(3, 1, 1));
  // Cuts at 1/2, and at 1/3 and 2/3: four parts.
  const std::vector<std::vector<std::int32_t>> both = {test::slabs(tets, 2), test::slabs(tets, 3)};
  const auto atomic = common_pieces(tets, both);
  EXPECT_EQ(1 + *std::ranges::max_element(atomic), 4);
  for (const auto& face : tets.interior_faces) {
    const auto [a, b] = face.tets;
    const bool joined = both[0][a] == both[0][b] && both[1][a] == both[1][b];
    EXPECT_EQ(atomic[a] == atomic[b], joined);
  }
}

TEST(AtomicPieces, OfPiecesThatDoNotTouchAreDifferent) {
  const TetMesh tets = test::tet_block({6, 2, 2}, Vec3(0, 0, 0), Vec3(3, 1, 1));
  auto pieces = test::slabs(tets, 3);
  for (std::int32_t& p : pieces) p %= 2;  // both ends are one piece of the mode
  const std::vector<std::vector<std::int32_t>> mode = {pieces};
  const auto atomic = common_pieces(tets, mode);
  EXPECT_EQ(1 + *std::ranges::max_element(atomic), 3);
}

TEST(AtomicPieces, WithoutModesAreTheWholeBody) {
  const TetMesh tets = test::tet_block({2, 2, 2}, Vec3(0, 0, 0), Vec3(1, 1, 1));
  const auto atomic = common_pieces(tets, {});
  EXPECT_EQ(*std::ranges::max_element(atomic), 0);
}

TEST(AtomicPieces, OfABarAreItsQuarters) {
  const test::Bar bar = test::bar();
  const AtomicPieces pieces = cut(bar, {});
  ASSERT_EQ(pieces.cut.cells.size(), 4u);
  for (const auto& cell : pieces.cut.cells) EXPECT_NEAR(cell.volume, 1, 1e-4);
}

TEST(AtomicPieces, BelowTheMinimumVolumeJoinTheNeighbourWithTheLargestSharedFace) {
  const test::Bar bar = test::bar();
  // A slice of an eighth of the bar at one end, and a single tet in the middle of the other half.
  std::vector<std::int32_t> slice(bar.tets.tets.size(), 0), speck = slice;
  for (std::size_t t = 0; t < slice.size(); ++t)
    slice[t] = test::centroid(bar.tets, t).x() < -0.375;
  for (std::size_t t = 0; t < slice.size(); ++t) {
    if (test::centroid(bar.tets, t).x() > 0.26) {
      speck[t] = 1;
      break;
    }
  }
  const FractureModes found = test::made_up_modes(bar.tets, {slice, speck});
  const auto count = [&](double minimum_volume) {
    test::Surroundings surroundings;
    Context context = surroundings.context();
    const AtomicPieces pieces = atomic_pieces(bar.target.mesh, bar.tets, found,
                                              {.minimum_volume = minimum_volume}, context);
    for (const auto& cell : pieces.cut.cells) EXPECT_GE(cell.volume, minimum_volume);
    return pieces.cut.cells.size();
  };
  EXPECT_EQ(count(0), 3u);
  EXPECT_EQ(count(0.1), 2u);
  EXPECT_EQ(count(1), 1u);
}

TEST(AtomicPieces, LeaveNoTraceOfRegionsThatAreMergedAway) {
  const test::Bar bar = test::bar();
  const AtomicPieces halves = cut(bar, {.wanted = 2});
  const std::size_t with_quarters = cut(bar, {}).cut.surface.size();
  EXPECT_LT(halves.cut.surface.size(), with_quarters);
  const AtomicPieces whole = cut(bar, {.wanted = 1});
  EXPECT_EQ(whole.cut.surface.size(), bar.target.mesh.faces.size());
  EXPECT_TRUE(whole.cut.interfaces.empty());
}

// Both cuts of the second mode are cheaper to lose than that of the first.
TEST(AtomicPieces, AsManyAsWantedKeepTheCutOfTheFirstMode) {
  const test::Bar bar = test::bar();
  EXPECT_EQ(cut(bar, {.wanted = 3}).cut.cells.size(), 3u);
  const AtomicPieces halves = cut(bar, {.wanted = 2});
  ASSERT_EQ(halves.cut.cells.size(), 2u);
  for (const auto& cell : halves.cut.cells) EXPECT_NEAR(cell.volume, 2, 1e-4);
  EXPECT_EQ(cut(bar, {.wanted = 9}).cut.cells.size(), 4u);
}

// Ward's rule: a small part that moves much costs less than a large one.
TEST(AtomicPieces, MergingLosesAsLittleOfTheModesAsCanBe) {
  const test::Bar bar = test::bar();
  const auto regions = test::slabs(bar.tets, 8);
  test::Surroundings surroundings;
  Context context = surroundings.context();
  const CutBody cut = cut_body(bar.target.mesh, bar.tets, regions, context);
  Eigen::MatrixXd motion(1, 8);
  motion << 0, 1, 5, 5.5, 9, 9.2, 12, 20;
  for (int wanted = 7; wanted >= 1; --wanted) {
    const auto group = merge_cells(cut, motion, {.wanted = wanted});
    EXPECT_EQ(1 + *std::ranges::max_element(group), wanted);
  }
  const std::vector<std::int32_t> four = {0, 0, 1, 1, 2, 2, 2, 3};
  EXPECT_EQ(merge_cells(cut, motion, {.wanted = 4}), four);
}

TEST(AtomicPieces, SharesOfRegionsAddUpToThePieces) {
  Random random(4);
  Target target{"sphere", test::sphere(3), {}};
  const BoundingBox box = bounding_box(target.mesh);
  const TetMesh tets = test::tet_block({4, 4, 4}, box.low * 1.2, box.high * 1.2);
  const auto found = test::made_up_modes(
      tets, {test::voronoi_regions(tets, 5, random), test::voronoi_regions(tets, 4, random)});
  test::Surroundings surroundings;
  Context context = surroundings.context();
  const AtomicPieces pieces =
      atomic_pieces(target.mesh, tets, found, {.minimum_volume = 0.02, .wanted = 6}, context);
  EXPECT_LE(pieces.cut.cells.size(), 6u);
  double total = 0;
  for (std::size_t p = 0; p < pieces.regions.size(); ++p) {
    double sum = 0;
    for (const auto& share : pieces.regions[p]) sum += share.volume;
    EXPECT_NEAR(sum, pieces.cut.cells[p].volume, 1e-12);
    total += sum;
  }
  EXPECT_NEAR(total, volume(target.mesh), 1e-12);
}

}  // namespace
}  // namespace fracbench
