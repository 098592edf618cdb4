#include "reports/items/impulse_response.h"

#include <algorithm>

#include "metrics/rank_correlation.h"
#include "metrics/summary.h"
#include "reports/cell_groups.h"

namespace fracbench {

namespace {

/// What the broken cells of one method and shape have: impulse, fragments, share of the largest.
struct Response {
  std::vector<double> impulse, count, largest;
};

Response response_of(std::span<const CellRef> cells) {
  Response response;
  for (const CellSummary& cell : cells) {
    const auto count = value_of(cell, "fragment_count");
    const std::span<const double> volumes = series_of(cell, "fragment_volume");
    if (cell.impulses.empty() || !count || volumes.empty()) continue;
    response.impulse.push_back(cell.impulses.front());
    response.count.push_back(*count);
    response.largest.push_back(*std::ranges::max_element(volumes));
  }
  return response;
}

/// Spearman's, with the interval from drawing collisions.
TableCell correlation(std::span<const CellRef> cells, std::vector<double> Response::*quantity,
                      const ReportInput& input, std::string_view name) {
  return estimate(
      cells,
      [&](std::span<const CellRef> chosen) {
        const Response response = response_of(chosen);
        return rank_correlation(response.impulse, response.*quantity);
      },
      input, name);
}

Table response_table(const std::vector<CellGroup>& groups, const ReportInput& input) {
  Table table{.name = "impulse_response",
              .title = "Stronger impulses",
              .notes = {"Spearman's rank correlation with the largest impulse, over the collisions "
                        "that broke the body: the paper shows more fragments and smaller ones "
                        "(supplement, figure 2), so that the first is positive and the second "
                        "negative."},
              .columns = {{"shape"},
                          {"method"},
                          {"collisions"},
                          {"number of fragments"},
                          {"volume of the largest"}}};
  for (const CellGroup& group : groups) {
    const std::vector<CellRef> cells = broken_cells(group.cells);
    const Response response = response_of(cells);
    if (response.impulse.size() < 3) continue;
    const std::string name = group.shape + " " + group.label;
    table.rows.push_back(
        {group.shape, group.label, static_cast<std::int64_t>(by_collision(cells).size()),
         correlation(cells, &Response::count, input, name + " impulse count"),
         correlation(cells, &Response::largest, input, name + " impulse largest")});
  }
  return table;
}

/// Of the collisions themselves: methods meet the same ones.
Table impulse_table(const ReportInput& input) {
  Table table{
      .name = "impulses",
      .title = "Impulses",
      .notes = {"Of each collision that touched the body: the strongest impulse and the one "
                "after it, in the step in which the body broke or in the hardest one."},
      .columns = {{"shape"},
                  {"family"},
                  {"collisions"},
                  {"largest", "N s"},
                  {"second largest", "N s"},
                  {"collisions with two"}}};
  struct Row {
    std::string shape, family;
    std::vector<double> first = {}, second = {};
  };
  std::vector<Row> rows;
  for (const CellGroup& group : group_cells(input.cells)) {
    for (const std::vector<CellRef>& collision : by_collision(group.cells)) {
      const CellSummary& cell = collision.front();
      const bool of_first_method = group.label == input.cells.front().label;
      if (cell.impulses.empty() || !of_first_method) continue;
      auto row = std::ranges::find_if(
          rows, [&](const Row& r) { return r.shape == cell.shape && r.family == cell.family; });
      if (row == rows.end()) row = rows.insert(rows.end(), {cell.shape, cell.family});
      row->first.push_back(cell.impulses[0]);
      if (cell.impulses.size() > 1) row->second.push_back(cell.impulses[1]);
    }
  }
  for (const Row& row : rows) {
    TableCell second;
    if (!row.second.empty()) second = summarize(row.second).mean;
    table.rows.push_back({row.shape, row.family, static_cast<std::int64_t>(row.first.size()),
                          summarize(row.first).mean, second,
                          static_cast<std::int64_t>(row.second.size())});
  }
  return table;
}

std::vector<Figure> figures_of(const std::vector<CellGroup>& groups, const ReportInput& input) {
  std::vector<Figure> figures;
  std::string shape;
  for (const CellGroup& group : groups) {
    const Response response = response_of(broken_cells(group.cells));
    if (response.impulse.empty()) continue;
    if (figures.empty() || shape != group.shape) {
      shape = group.shape;
      figures.push_back({.name = "impulse_response_" + file_name_part(shape),
                         .title = "Fragments by impulse: " + shape,
                         .x = {.label = "largest impulse [N s]", .logarithmic = true},
                         .y = {.label = "fragments"}});
    }
    figures.back().series.push_back({.name = group.label,
                                     .colour = method_place(input, group.label),
                                     .mark = Mark::dots,
                                     .x = response.impulse,
                                     .y = response.count});
  }
  return figures;
}

}  // namespace

ReportItemInfo ImpulseResponse::info() const {
  return {.name = "impulse_response", .title = "Impulses and what they do"};
}

ReportSection ImpulseResponse::render(const ReportInput& input) const {
  if (input.cells.empty()) return {};
  const std::vector<CellGroup> groups = group_cells(input.cells);
  ReportSection section{.paragraphs = {}, .tables = {}, .figures = figures_of(groups, input)};
  for (Table& table : std::vector<Table>{response_table(groups, input), impulse_table(input)}) {
    if (!table.rows.empty()) section.tables.push_back(std::move(table));
  }
  return section;
}

}  // namespace fracbench
