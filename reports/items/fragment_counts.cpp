#include "reports/items/fragment_counts.h"

#include "metrics/summary.h"
#include "reports/cell_groups.h"
#include "reports/figure_of_table.h"

namespace fracbench {

ReportItemInfo FragmentCounts::info() const {
  return {.name = "fragment_counts", .title = "Number of fragments"};
}

ReportSection FragmentCounts::render(const ReportInput& input) const {
  Table table{.name = "fragment_counts",
              .title = "Fragments per collision",
              .notes = {"Mean of the collisions that broke the body. Above the minimum: volumes of "
                        "at least 50 voxels of the paper's grid of 128^3 (`docs/metrics.md`)."},
              .columns = {{"shape"},
                          {"method"},
                          {"collisions"},
                          {"mean"},
                          {"median"},
                          {"least"},
                          {"most"},
                          {"mean above minimum"},
                          {"minimum", "of V_body"}}};
  for (const CellGroup& group : group_cells(input.cells)) {
    const std::vector<CellRef> cells = broken_cells(group.cells);
    const std::vector<double> counts = values_of(cells, "fragment_count");
    if (counts.empty()) continue;
    const Summary summary = summarize(counts);
    const std::vector<double> minimum = values_of(cells, "minimum_volume_fraction");
    table.rows.push_back({group.shape, group.label,
                          static_cast<std::int64_t>(by_collision(cells).size()),
                          estimated_mean(cells, "fragment_count", input),
                          quantile(counts, 0.5).value(), summary.minimum, summary.maximum,
                          estimated_mean(cells, "fragment_count_above_minimum", input),
                          number_or_nothing(quantile(minimum, 1))});
  }
  if (table.rows.empty()) return {};
  ReportSection section{.paragraphs = {}, .tables = {table}};
  if (auto figure = figure_of_column(table, 3, input,
                                     {.name = "fragment_counts",
                                      .title = "Fragments per collision",
                                      .x = {.label = "shape"},
                                      .y = {.label = "fragments (mean)"}})) {
    section.figures.push_back(std::move(*figure));
  }
  return section;
}

}  // namespace fracbench
