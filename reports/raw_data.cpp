#include "reports/raw_data.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/cell_groups.h"

namespace fracbench {
namespace {

// Seeds fill 64 bits, which a signed number has not: text keeps them whole.
std::vector<TableCell> identity(const CellSummary& cell) {
  return {cell.shape,
          cell.label,
          cell.method,
          cell.family,
          cell.scenario,
          static_cast<std::int64_t>(cell.repeat),
          fmt::format("{}", cell.seed)};
}

const std::vector<TableColumn> kIdentity{{"shape"},    {"label"},  {"method"}, {"family"},
                                         {"scenario"}, {"repeat"}, {"seed"}};

}  // namespace

std::string cells_csv(const ReportInput& input) {
  Table table{.name = {}, .title = {}, .columns = kIdentity};
  for (const char* name : {"status", "reason", "breaks"}) table.columns.push_back({name});
  table.columns.push_back({"impulse", "N s"});
  table.columns.push_back({"threads"});
  table.columns.push_back({"cpu"});
  table.columns.push_back({"key"});
  std::vector<TableColumn> metrics;
  for (const CellSummary& cell : input.cells) {
    for (const MetricValue& value : cell.values) {
      if (std::ranges::find(metrics, value.name, &TableColumn::name) == metrics.end()) {
        metrics.push_back({value.name, value.unit});
      }
    }
  }
  table.columns.insert(table.columns.end(), metrics.begin(), metrics.end());
  std::string text = to_csv(table);
  for (const CellSummary& cell : input.cells) {
    std::optional<double> strongest;
    if (!cell.impulses.empty()) strongest = cell.impulses.front();
    std::vector<TableCell> row = identity(cell);
    row.insert(row.end(), {std::string(to_string(cell.status)), cell.reason,
                           static_cast<std::int64_t>(cell.breaks), number_or_nothing(strongest),
                           static_cast<std::int64_t>(cell.threads), cell.cpu, cell.key});
    for (const TableColumn& metric : metrics) {
      row.push_back(number_or_nothing(value_of(cell, metric.name)));
    }
    table.rows = {std::move(row)};
    text += csv_rows(table);
  }
  return text;
}

std::string volumes_csv(const ReportInput& input) {
  Table table{.name = {}, .title = {}, .columns = kIdentity};
  table.columns.push_back({"status"});
  table.columns.push_back({"fragment"});
  table.columns.push_back({"volume", "V_body / 10"});
  std::string text = to_csv(table);
  for (const CellSummary& cell : input.cells) {
    table.rows.clear();
    std::int64_t number = 0;
    for (const double volume : series_of(cell, "fragment_volume")) {
      std::vector<TableCell> row = identity(cell);
      row.insert(row.end(), {std::string(to_string(cell.status)), number++, volume});
      table.rows.push_back(std::move(row));
    }
    text += csv_rows(table);
  }
  return text;
}

}  // namespace fracbench
