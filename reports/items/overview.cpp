#include "reports/items/overview.h"

#include <algorithm>
#include <map>

#include "reports/cell_groups.h"

namespace fracbench {

ReportItemInfo Overview::info() const { return {.name = "overview", .title = "Overview"}; }

ReportSection Overview::render(const ReportInput& input) const {
  if (input.study) return {};
  Table cells{.name = "overview",
              .title = "Cells by status",
              .columns = {{"shape"}, {"method"}, {"cells"}}};
  for (const CellStatus status : kCellStatuses) {
    cells.columns.push_back({std::string(to_string(status))});
  }
  for (const CellGroup& group : group_cells(input.cells)) {
    auto& row = cells.rows.emplace_back();
    row = {group.shape, group.label, static_cast<std::int64_t>(group.cells.size())};
    for (const CellStatus status : kCellStatuses) {
      row.emplace_back(std::ranges::count(group.cells, status, &CellSummary::status));
    }
  }
  ReportSection section{.paragraphs = {}, .tables = {cells}};

  Table reasons{.name = "reasons",
                .title = "Why cells did not end well",
                .columns = {{"shape"}, {"method"}, {"status"}, {"cells"}, {"reason"}}};
  using Key = std::pair<CellStatus, std::string>;
  for (const CellGroup& group : group_cells(input.cells)) {
    std::map<Key, std::int64_t> counts;
    for (const CellSummary& cell : group.cells) {
      if (cell.status != CellStatus::ok && cell.status != CellStatus::unbroken) {
        ++counts[{cell.status, cell.reason}];
      }
    }
    for (const auto& [key, count] : counts) {
      reasons.rows.push_back(
          {group.shape, group.label, std::string(to_string(key.first)), count, key.second});
    }
  }
  if (!reasons.rows.empty()) section.tables.push_back(reasons);
  return section;
}

}  // namespace fracbench
