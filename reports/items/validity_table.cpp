#include "reports/items/validity_table.h"

#include <algorithm>
#include <cmath>

#include "metrics/summary.h"
#include "reports/cell_groups.h"

namespace fracbench {
namespace {

// Largest distance from 1.
std::optional<double> worst_error(const std::vector<double>& values) {
  std::optional<double> worst;
  for (const double value : values) worst = std::max(worst.value_or(0), std::abs(value - 1));
  return worst;
}

}  // namespace

ReportItemInfo ValidityTable::info() const { return {.name = "validity", .title = "Validity"}; }

ReportSection ValidityTable::render(const ReportInput& input) const {
  Table table{.name = "validity",
              .title = "Worst cases",
              .notes = {"Of all cells that have fragments, whatever their status. Volume error: of "
                        "`volume_ratio` from 1."},
              .columns = {{"shape"},
                          {"method"},
                          {"cells"},
                          {"valid"},
                          {"closed"},
                          {"oriented"},
                          {"no self-intersection"},
                          {"disjoint"},
                          {"worst volume error"},
                          {"least surface retention"},
                          {"largest surface distance", "m"}}};
  for (const CellGroup& group : group_cells(input.cells)) {
    std::vector<CellRef> cells;
    std::ranges::copy_if(group.cells, std::back_inserter(cells), [](const CellSummary& cell) {
      return cell.status != CellStatus::unbroken && value_of(cell, "valid").has_value();
    });
    if (cells.empty()) continue;
    auto& row = table.rows.emplace_back();
    row = {group.shape, group.label, static_cast<std::int64_t>(cells.size())};
    for (const char* metric :
         {"valid", "closed", "oriented", "self_intersection_free", "disjoint"}) {
      row.emplace_back(
          static_cast<std::int64_t>(std::ranges::count(values_of(cells, metric), 1.0)));
    }
    row.push_back(number_or_nothing(worst_error(values_of(cells, "volume_ratio"))));
    row.push_back(number_or_nothing(quantile(values_of(cells, "surface_retention"), 0)));
    row.push_back(number_or_nothing(quantile(values_of(cells, "surface_distance"), 1)));
  }
  if (table.rows.empty()) return {};
  return {.paragraphs = {}, .tables = {table}};
}

}  // namespace fracbench
