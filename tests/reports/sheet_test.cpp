#include "reports/picture/sheet.h"

#include <gtest/gtest.h>

#include "synthetic_cells.h"

namespace fracbench {
namespace {

using namespace synthetic;

TEST(Sheet, ShowsTheCollisionThatMostMethodsBroke) {
  std::vector<CellSummary> cells;
  for (const int collision : {0, 1, 2}) {
    for (const char* label : {"a", "b"}) {
      const bool broken = collision == 1 || label[0] == 'b';
      cells.push_back(broken ? broken_cell(label, "pot", collision, {6, 4})
                             : failed_cell(label, "pot", collision, CellStatus::unbroken, ""));
    }
  }
  cells.push_back(failed_cell("c", "pot", 1, CellStatus::crash, "signal 11"));
  const auto rows = sheet_rows(cells);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].cells.at("a"), &cells[2]);
  EXPECT_FALSE(rows[0].cells.contains("c")) << "there is nothing to see of a crash";
  EXPECT_EQ(sheet_columns(cells, rows), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(sheet_rows(cells, {.collisions = 9}).size(), 3u);
  EXPECT_TRUE(sheet_rows(cells, {.shapes = {"mug"}}).empty());
  EXPECT_EQ(sheet_columns(cells, sheet_rows(cells, {.methods = {"b"}})),
            (std::vector<std::string>{"b"}));
}

TEST(Sheet, NamesOfFilesHoldNothingThatLeadsElsewhere) {
  EXPECT_EQ(picture_name({.name = "../pot-0", .cells = {}}, "a/b"), ".._pot-0-a_b");
}

}  // namespace
}  // namespace fracbench
