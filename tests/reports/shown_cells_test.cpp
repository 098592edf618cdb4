#include "reports/page/shown_cells.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "synthetic_cells.h"

namespace fracbench {
namespace {

using synthetic::broken_cell;

/// Three shapes with 20, 20 and 3 collisions, two methods each.
std::vector<CellSummary> cells() {
  std::vector<CellSummary> result;
  for (const auto& [shape, count] : {std::pair{"bunny", 20}, {"pot", 20}, {"spot", 3}}) {
    for (int collision = 0; collision < count; ++collision) {
      for (const char* label : {"bem", "cvd"}) {
        result.push_back(broken_cell(label, shape, collision, {4, 6}));
      }
    }
  }
  return result;
}

TEST(ShownCells, AreAllWhereTheyAreFew) {
  EXPECT_EQ(shown_cells(cells(), 86).size(), 86);
  EXPECT_EQ(shown_cells({}, 10).size(), 0);
}

TEST(ShownCells, AreWholeCollisionsSpreadOverTheShapes) {
  const auto shown = shown_cells(cells(), 25);
  EXPECT_EQ(shown.size(), 24);
  std::map<std::string, int> of_shape;
  std::map<std::string, int> of_method;
  for (const CellSummary& cell : shown) ++of_shape[cell.shape], ++of_method[cell.label];
  EXPECT_EQ(of_method["bem"], of_method["cvd"]);
  EXPECT_EQ(of_shape["spot"], 6);
  EXPECT_LE(std::abs(of_shape["bunny"] - of_shape["pot"]), 2);
}

TEST(ShownCells, KeepTheirOrderAndAreAtLeastOneCollision) {
  const auto all = cells();
  const auto shown = shown_cells(all, 1);
  ASSERT_EQ(shown.size(), 2);
  EXPECT_EQ(shown[0].key, all[0].key);
  EXPECT_EQ(shown[1].key, all[1].key);
}

}  // namespace
}  // namespace fracbench
