#include "synthetic_cells.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "metrics/mott.h"
#include "metrics/summary.h"
#include "reports/report_items.h"

namespace fracbench::synthetic {

CellSummary broken_cell(std::string label, std::string shape, int collision,
                        std::vector<double> volumes) {
  CellSummary cell;
  cell.key = fmt::format("{}-{}-{}", label, shape, collision);
  cell.method = label;
  cell.label = std::move(label);
  cell.shape = std::move(shape);
  cell.family = "single";
  cell.scenario = fmt::format("{:04}", collision);
  cell.seed = 0xFFFFFFFFFFFFFFFFu;
  cell.values = {
      {"fragment_count", static_cast<double>(volumes.size()), ""},
      {"fragment_count_above_minimum",
       static_cast<double>(std::ranges::count_if(volumes, [](double v) { return v >= 0.01; })), ""},
      {"minimum_volume_fraction", 0.001, ""},
      {"normal_along", 0.5, ""},
      {"normal_across", 0.75, ""},
      {"fabric_1", 0.5, ""},
      {"fabric_2", 0.3, ""},
      {"fabric_3", 0.2, ""},
      {"roughness", 0, "degree"},
      {"valid", 1, ""},
      {"closed", 1, ""},
      {"oriented", 1, ""},
      {"self_intersection_free", 1, ""},
      {"disjoint", 1, ""},
      {"volume_ratio", 1, ""},
      {"surface_retention", 1, ""},
      {"surface_distance", 0, "m"}};
  cell.series = {{"fragment_volume", std::move(volumes), "V_body / 10"}};
  cell.stages = {{"cells", 0.25}, {"cut", 0.75}};
  cell.total_seconds = 1.01;
  cell.peak_memory = 2e8;
  cell.impulses = {2e5, 1e5};
  cell.breaks = 1;
  return cell;
}

CellSummary failed_cell(std::string label, std::string shape, int collision, CellStatus status,
                        std::string reason) {
  CellSummary cell = broken_cell(std::move(label), std::move(shape), collision, {});
  cell.status = status;
  cell.reason = std::move(reason);
  cell.values.clear();
  cell.series.clear();
  return cell;
}

std::vector<double> mott_volumes(Random& random, double mean, int count) {
  std::vector<double> volumes;
  for (int i = 0; i < count; ++i) {
    volumes.push_back(Mott{.mean_volume = mean}.quantile(random.uniform()));
  }
  return volumes;
}

ReportInput two_methods(int collisions, bool differ) {
  Random random(4);
  ReportInput input{.title = "Two methods", .bootstrap = {.resamples = 200}, .seed = 3};
  for (int i = 0; i < collisions; ++i) {
    input.cells.push_back(broken_cell("fine", "squirrel", i, mott_volumes(random, 0.6, 17)));
    input.cells.push_back(
        broken_cell("coarse", "squirrel", i, mott_volumes(random, differ ? 2.4 : 0.6, 17)));
  }
  return input;
}

ReportSection section(const ReportInput& input, std::string_view item) {
  for (const auto& candidate : report_items()) {
    if (candidate->info().name == item) return candidate->render(input);
  }
  ADD_FAILURE() << "no item " << item;
  return {};
}

Table table(const ReportSection& section, std::string_view name) {
  const auto found = std::ranges::find(section.tables, name, &Table::name);
  if (found != section.tables.end()) return *found;
  ADD_FAILURE() << "no table " << name;
  return {};
}

TableCell at(const Table& table, std::size_t row, std::string_view column) {
  const auto found = std::ranges::find(table.columns, column, &TableColumn::name);
  if (found == table.columns.end() || row >= table.rows.size()) {
    ADD_FAILURE() << "no place " << row << " " << column << " in " << table.name;
    return {};
  }
  return table.rows[row].at(found - table.columns.begin());
}

}  // namespace fracbench::synthetic
