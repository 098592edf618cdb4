#include "reports/shape_volumes.h"

#include <gmock/gmock.h>

#include <array>

#include "metrics/summary.h"
#include "tests/reports/synthetic_cells.h"

namespace fracbench {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(CollisionVolumes, ThoseOfOneMethodAboveTheCutAscendingAndAsOftenAsDrawn) {
  const std::vector<CellSummary> cells = {
      synthetic::broken_cell("cvd", "pot", 0, {5, 0.5, 4.5}),
      synthetic::broken_cell("bem", "pot", 0, {9, 1}),
      synthetic::broken_cell("cvd", "pot", 1, {7, 3}),
      synthetic::broken_cell("bem", "pot", 2, {6, 4}),
  };
  const std::vector<std::vector<CellRef>> collisions =
      by_collision(std::vector<CellRef>(cells.begin(), cells.end()));
  const CollisionVolumes volumes(collisions, "cvd", 0.5);

  EXPECT_THAT(volumes.of(std::array<std::size_t, 3>{0, 1, 2}), ElementsAre(3, 4.5, 5, 7));
  EXPECT_THAT(volumes.of(std::array<std::size_t, 3>{1, 0, 1}), ElementsAre(3, 3, 4.5, 5, 7, 7));
  EXPECT_THAT(volumes.of(std::array<std::size_t, 1>{2}), IsEmpty());
}

TEST(CollisionVolumes, AreThoseOfTheCellsThemselves) {
  const ReportInput input = synthetic::two_methods(40, true);
  for (const ShapeVolumes& shape : volumes_by_shape(input)) {
    for (const CellGroup& group : shape.methods) {
      const std::vector<std::vector<CellRef>> collisions = by_collision(group.cells);
      const std::array<std::size_t, 5> chosen = {3, 0, 3, 17, 39};
      std::vector<CellRef> cells;
      for (const std::size_t c : chosen) {
        cells.insert(cells.end(), collisions[c].begin(), collisions[c].end());
      }
      EXPECT_EQ(CollisionVolumes(collisions, group.label, shape.cut).of(chosen),
                sorted(volumes_above(cells, shape.cut)));
    }
  }
}

}  // namespace
}  // namespace fracbench
