#include "geometry/segmentation/join_labels.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace fracbench {
namespace {

/// One layer, a line of text per row: digits are labels, '#' walls, ' ' voxels without a label.
FloodGrid layer(const std::vector<std::string_view>& rows) {
  const VoxelGrid<float> field({static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), 1},
                               Vec3::Zero(), 1, 1.0f);
  FloodGrid grid = make_flood_grid(field, 0, true);
  for (int j = 0; j < field.size[1]; ++j) {
    for (int i = 0; i < field.size[0]; ++i) {
      const char c = rows[j][i];
      grid.label(grid.index(i, j, 0)) = c == '#' ? flood::wall : c == ' ' ? flood::dam : c - '0';
    }
  }
  return grid;
}

std::vector<std::int32_t> labels(const FloodGrid& grid) {
  std::vector<std::int32_t> all;
  for (const FloodGrid::Brick& brick : grid.storage) {
    for (const FloodGrid::Cell& cell : brick.cells) all.push_back(cell.label);
  }
  return all;
}

std::vector<std::int64_t> voxels_of(const FloodGrid& grid, int count) {
  std::vector<std::int64_t> voxels(count + 1, 0);
  for (const std::int32_t label : labels(grid)) {
    if (label > 0) ++voxels[label];
  }
  return voxels;
}

TEST(Dams, GoToTheLabelThatMostNeighboursCarry) {
  FloodGrid grid = layer({"121",  //
                          "2 2",  //
                          "112"});
  EXPECT_EQ(give_dams_to_labels(grid), 1);
  EXPECT_EQ(labels(grid), labels(layer({"121", "222", "112"})));
}

TEST(Dams, GoToTheLowestLabelWhereTheSharesAreEqual) {
  FloodGrid grid = layer({"#3#",  //
                          "2 2",  //
                          "#3#"});
  give_dams_to_labels(grid);
  EXPECT_EQ(labels(grid), labels(layer({"#3#", "222", "#3#"})));
}

TEST(Dams, ThickOnesAreFilledFromBothSides) {
  FloodGrid grid = layer({"1     2"});
  EXPECT_EQ(give_dams_to_labels(grid), 5);
  EXPECT_EQ(labels(grid), labels(layer({"1111222"})));
}

TEST(Dams, StayWhereNoLabelReachesThem) {
  FloodGrid grid = layer({"1 #  "});
  EXPECT_EQ(give_dams_to_labels(grid), 1);
  EXPECT_EQ(labels(grid), labels(layer({"11#  "})));
}

TEST(SmallLabels, GoToTheLongestBorder) {
  const FloodGrid grid = layer({"11122222",  //
                                "11133222",  //
                                "11122222"});
  const JoinedLabels joined = join_small_labels(grid, voxels_of(grid, 3), 3);
  EXPECT_EQ(joined.target, (std::vector<std::int32_t>{0, 1, 2, 2}));
  EXPECT_EQ(joined.joined, 1);
  EXPECT_EQ(joined.islands, 0);
}

TEST(SmallLabels, GoToTheLowestNeighbourWhereBordersAreEqual) {
  const FloodGrid grid = layer({"2223111"});
  EXPECT_EQ(join_small_labels(grid, voxels_of(grid, 3), 2).target,
            (std::vector<std::int32_t>{0, 1, 2, 1}));
}

TEST(SmallLabels, JoinEachOtherUntilTheyAreLargeEnough) {
  // 1 is the smallest and goes to 2, which is then large enough.
  const FloodGrid grid = layer({"12233333"});
  const JoinedLabels joined = join_small_labels(grid, voxels_of(grid, 3), 3);
  EXPECT_EQ(joined.target, (std::vector<std::int32_t>{0, 2, 2, 3}));
  EXPECT_EQ(joined.joined, 1);
}

TEST(SmallLabels, FollowTheirReceiverWhereItIsGivenAwayToo) {
  const FloodGrid grid = layer({"12233333"});
  const JoinedLabels joined = join_small_labels(grid, voxels_of(grid, 3), 4);
  EXPECT_EQ(joined.target, (std::vector<std::int32_t>{0, 3, 3, 3}));
  EXPECT_EQ(joined.joined, 2);
}

TEST(SmallLabels, WithoutNeighboursStayAsIslands) {
  const FloodGrid grid = layer({"12#33333"});
  const JoinedLabels joined = join_small_labels(grid, voxels_of(grid, 3), 4);
  EXPECT_EQ(joined.target, (std::vector<std::int32_t>{0, 2, 2, 3}));
  EXPECT_EQ(joined.joined, 1);
  EXPECT_EQ(joined.islands, 1);
}

}  // namespace
}  // namespace fracbench
