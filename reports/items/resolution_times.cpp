#include "reports/items/resolution_times.h"

#include <algorithm>
#include <map>
#include <set>

#include "metrics/summary.h"
#include "reports/cell_groups.h"

namespace fracbench {

namespace {

constexpr const char* kStages[] = {"prediction", "segmentation", "boolean"};

/// Seconds of a stage by resolution, of one shape.
using ByResolution = std::map<int, std::vector<double>>;

}  // namespace

ReportItemInfo ResolutionTimes::info() const {
  return {.name = "resolution_times", .title = "Times by resolution"};
}

ReportSection ResolutionTimes::render(const ReportInput& input) const {
  std::map<std::string, std::map<std::string, ByResolution>> seconds;  // by shape and stage
  std::vector<std::string> shapes;
  std::set<int> resolutions;
  for (const CellSummary& cell : input.cells) {
    const int r = cut_resolution(cell);
    if (cell.status != CellStatus::ok || r == 0) continue;
    for (const char* stage : kStages) {
      const auto found = std::ranges::find(cell.stages, stage, &StageTime::name);
      if (found == cell.stages.end()) continue;
      if (!seconds.contains(cell.shape)) shapes.push_back(cell.shape);
      seconds[cell.shape][stage][r].push_back(found->seconds);
      resolutions.insert(r);
    }
  }
  if (resolutions.size() < 2) return {};
  Table table{
      .name = "resolution_times",
      .title = "Stages by resolution",
      .notes = {"Means over the collisions that broke the body, on this machine."},
      .columns = {{"shape"}, {"stage"}, {"r"}, {"cells"}, {"mean", "s"}, {"deviation", "s"}}};
  ReportSection section;
  for (const std::string& shape : shapes) {
    Figure figure{.name = "resolution_times_" + file_name_part(shape),
                  .title = "Times by resolution: " + shape,
                  .x = {.label = "r", .logarithmic = true},
                  .y = {.label = "time [s]", .logarithmic = true}};
    for (std::size_t s = 0; s < std::size(kStages); ++s) {
      FigureSeries series{.name = kStages[s], .colour = s};
      for (const auto& [r, values] : seconds[shape][kStages[s]]) {
        const Summary summary = summarize(values);
        table.rows.push_back({shape, std::string(kStages[s]), std::int64_t{r},
                              static_cast<std::int64_t>(summary.count), summary.mean,
                              summary.deviation()});
        series.x.push_back(r);
        series.y.push_back(summary.mean);
      }
      figure.series.push_back(std::move(series));
    }
    section.figures.push_back(std::move(figure));
  }
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace fracbench
