#include "geometry/segmentation/watershed.h"

#include <gtest/gtest.h>

#include "heap_segmentation.h"
#include "test_fields.h"

namespace fracbench {
namespace {

TEST(Watershed, MinimaAndLabelsAreThoseOfTheRulesWrittenDownPlainly) {
  for (const auto& [name, field] : test::all_fields()) {
    for (const bool inside_only : {false, true}) {
      for (const float h : {3.0f, 0.0f, 20.0f}) {
        SCOPED_TRACE(name + (inside_only ? ", inside, h " : ", whole grid, h ") +
                     std::to_string(h));
        const auto expected = reference::heap_segmentation(field, 0.03f, h, inside_only);
        FloodGrid grid = make_flood_grid(field, 0.03f, inside_only);
        const ExtendedMinima minima = label_extended_minima(grid, h);
        ASSERT_EQ(labels_of(grid, field).values, expected.markers.values);
        flood_watershed(grid, minima);
        ASSERT_EQ(labels_of(grid, field).values, expected.labels.values);
      }
    }
  }
}

TEST(Watershed, LabelsNeverTouchEachOther) {
  const VoxelGrid<float> field = test::voronoi_ball(32, 20, 3);
  FloodGrid grid = make_flood_grid(field, 0.03f, false);
  flood_watershed(grid, label_extended_minima(grid, 3));
  for (int k = 0; k < 32; ++k) {
    for (int j = 0; j < 32; ++j) {
      for (int i = 0; i < 32; ++i) {
        const std::int32_t voxel = grid.index(i, j, k);
        for (const std::int32_t step : grid.steps(voxel)) {
          const std::int32_t a = grid.label(voxel), b = grid.label(voxel + step);
          ASSERT_TRUE(a <= 0 || b <= 0 || a == b) << i << " " << j << " " << k;
        }
      }
    }
  }
}

TEST(Watershed, MoreDepthGivesNoMoreMinima) {
  const VoxelGrid<float> field = test::voronoi_ball(40, 30, 4);
  std::int32_t before = 1 << 30;
  for (const float h : {0.0f, 1.0f, 3.0f, 6.0f, 12.0f, 255.0f}) {
    FloodGrid grid = make_flood_grid(field, 0.03f, true);
    const std::int32_t count = label_extended_minima(grid, h).count;
    EXPECT_LE(count, before) << h;
    before = count;
  }
  EXPECT_EQ(before, 1);
}

}  // namespace
}  // namespace fracbench
