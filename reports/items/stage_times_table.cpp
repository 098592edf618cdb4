#include "reports/items/stage_times_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/sum.h"
#include "metrics/stage_times.h"
#include "metrics/summary.h"
#include "reports/cell_groups.h"
#include "reports/figure_of_table.h"

namespace fracbench {
namespace {

// Seconds of a stage in each cell, 0 where a cell did not come to it; "total" is the whole cell.
std::vector<double> seconds_of(std::span<const CellRef> cells, std::string_view stage) {
  std::vector<double> seconds;
  for (const CellSummary& cell : cells) {
    const auto found = std::ranges::find(cell.stages, stage, &StageTime::name);
    seconds.push_back(stage == "total"             ? cell.total_seconds
                      : found == cell.stages.end() ? 0
                                                   : found->seconds);
  }
  return seconds;
}

std::vector<std::string> stages_of(std::span<const CellRef> cells) {
  std::vector<std::string> names;
  for (const CellSummary& cell : cells) {
    for (const StageTime& stage : cell.stages) {
      if (std::ranges::find(names, stage.name) == names.end()) names.push_back(stage.name);
    }
  }
  names.emplace_back("total");
  return names;
}

// Sum of the stages over the total.
double coverage(const CellSummary& cell) {
  Sum sum;
  for (const StageTime& stage : cell.stages) sum += stage.seconds;
  return cell.total_seconds > 0 ? sum.value() / cell.total_seconds : 0;
}

Table stage_table(const std::vector<CellGroup>& groups) {
  Table table{.name = "stage_times",
              .title = "Time of each stage",
              .notes = {"Wall-clock time per collision that broke the body, on this machine."},
              .columns = {{"shape"},
                          {"method"},
                          {"stage"},
                          {"cells"},
                          {"mean", "s"},
                          {"deviation", "s"},
                          {"least", "s"},
                          {"most", "s"},
                          {"share", "%"}}};
  for (const CellGroup& group : groups) {
    const std::vector<CellRef> cells = broken_cells(group.cells);
    if (cells.empty()) continue;
    const double whole = summarize(seconds_of(cells, "total")).mean;
    for (const std::string& stage : stages_of(cells)) {
      const Summary s = summarize(seconds_of(cells, stage));
      table.rows.push_back(
          {group.shape, group.label, stage, static_cast<std::int64_t>(s.count), s.mean,
           s.deviation(), s.minimum, s.maximum,
           number_or_nothing(whole > 0 ? std::optional(100 * s.mean / whole) : std::nullopt)});
    }
  }
  return table;
}

Table machine_table(const std::vector<CellGroup>& groups) {
  Table table{.name = "machine",
              .title = "Accounting and memory",
              .notes = {"The stages of a cell must add up to its total within 2 %."},
              .columns = {{"shape"},
                          {"method"},
                          {"least coverage"},
                          {"most coverage"},
                          {"cells that do not add up"},
                          {"most memory", "MB"}}};
  for (const CellGroup& group : groups) {
    const std::vector<CellRef> cells = broken_cells(group.cells);
    if (cells.empty()) continue;
    std::vector<double> shares;
    std::vector<double> memory;
    for (const CellSummary& cell : cells) {
      shares.push_back(coverage(cell));
      memory.push_back(cell.peak_memory / 1e6);
    }
    const auto off = std::ranges::count_if(
        shares, [](double share) { return std::abs(share - 1) > kStageCoverageTolerance; });
    table.rows.push_back({group.shape, group.label, summarize(shares).minimum,
                          summarize(shares).maximum, static_cast<std::int64_t>(off),
                          summarize(memory).maximum});
  }
  return table;
}

std::optional<Figure> total_figure(const std::vector<CellGroup>& groups, const ReportInput& input) {
  Table totals;
  for (const CellGroup& group : groups) {
    const std::vector<CellRef> cells = broken_cells(group.cells);
    if (cells.empty()) continue;
    std::vector<double> seconds = seconds_of(cells, "total");
    const std::vector<double> preparing = seconds_of(cells, "prepare");
    for (std::size_t i = 0; i < seconds.size(); ++i) seconds[i] -= preparing[i];
    const Summary s = summarize(seconds);
    totals.rows.push_back({group.shape, group.label, Estimate{s.mean, s.minimum, s.maximum}});
  }
  return figure_of_column(
      totals, 2, input,
      {.name = "total_times",
       .title = "Time of a collision",
       .notes = {"Without preparing the body. Mean, and from the least to the most."},
       .x = {.label = "shape"},
       .y = {.label = "wall-clock time [s]", .logarithmic = true}});
}

}  // namespace

ReportItemInfo StageTimesTable::info() const { return {.name = "stage_times", .title = "Times"}; }

ReportSection StageTimesTable::render(const ReportInput& input) const {
  const std::vector<CellGroup> groups = group_cells(input.cells);
  ReportSection section;
  const Table stages = stage_table(groups);
  if (auto figure = total_figure(groups, input)) section.figures.push_back(std::move(*figure));
  for (Table& table : std::vector<Table>{stages, machine_table(groups)}) {
    if (!table.rows.empty()) section.tables.push_back(std::move(table));
  }
  return section;
}

}  // namespace fracbench
