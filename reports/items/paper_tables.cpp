#include "reports/items/paper_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "methods/registry.h"
#include "metrics/summary.h"
#include "reports/cell_groups.h"
#include "reports/published.h"
#include "reports/verdict.h"

namespace fracbench {

namespace {

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// The paper's name for the sum of three stages.
const std::vector<std::string> kReconstruction{"prediction", "segmentation", "boolean"};

/// Seconds of a stage of a cell; nothing where it has none.
std::optional<double> seconds_of(const CellSummary& cell, const std::string& stage) {
  if (stage == "total") return cell.total_seconds;
  if (stage == "mode_generation" || stage == "training") {
    // What the paper tells apart is what preparing a body takes here, learning data left out.
    return cell.prepare_seconds;
  }
  if (stage == "reconstruction") {
    double sum = 0;
    for (const std::string& part : kReconstruction) {
      const auto seconds = seconds_of(cell, part);
      if (!seconds) return std::nullopt;
      sum += *seconds;
    }
    return sum;
  }
  const auto found = std::ranges::find(cell.stages, stage, &StageTime::name);
  return found == cell.stages.end() ? std::nullopt : std::optional(found->seconds);
}

bool measures(const CellSummary& cell, const PublishedStage& stage) {
  return cell.method == stage.method &&
         (stage.resolution == 0 || cut_resolution(cell) == stage.resolution);
}

std::optional<double> mean_seconds(std::span<const CellRef> cells, const PublishedStage& stage) {
  std::vector<double> seconds;
  for (const CellSummary& cell : cells) {
    if (!measures(cell, stage)) continue;
    if (const auto s = seconds_of(cell, stage.stage)) seconds.push_back(*s);
  }
  return seconds.empty() ? std::nullopt : std::optional(summarize(seconds).mean);
}

std::vector<CellRef> broken_cells_of(const ReportInput& input, const std::string& shape) {
  std::vector<CellRef> cells;
  for (const CellSummary& cell : input.cells) {
    if (cell.shape == shape && cell.status == CellStatus::ok) cells.emplace_back(cell);
  }
  return cells;
}

std::vector<std::string> shapes_of(const ReportInput& input) {
  std::vector<std::string> shapes;
  for (const CellSummary& cell : input.cells) {
    if (std::ranges::find(shapes, cell.shape) == shapes.end()) shapes.push_back(cell.shape);
  }
  return shapes;
}

Table table_1(const ReportInput& input) {
  Table table{
      .name = "table_1",
      .title = "Table 1: kinds of methods",
      .notes = {"What a method is said to be in the paper, and what the one of that name "
                "here is. Times are in table 2."},
      .columns = {
          {"paper"}, {"method"}, {"property"}, {"published"}, {"here"}, {"verdict"}, {"erratum"}}};
  const auto yes_or_no = [](bool value) { return std::string(value ? "yes" : "no"); };
  for (const PublishedMethod& published : published_methods()) {
    const auto run = std::ranges::any_of(
        input.cells, [&](const CellSummary& cell) { return cell.method == published.method; });
    const auto found = std::ranges::find_if(
        methods(), [&](const auto& m) { return m->info().name == published.method; });
    const auto add = [&](const char* property, const std::string& there, const auto& here) {
      std::string text;
      auto verdict = Verdict::not_comparable;
      if (run && found != methods().end()) {
        text = here((*found)->info());
        verdict = text == there ? Verdict::match : Verdict::mismatch;
      }
      table.rows.push_back({published.row, published.method, std::string(property), there, text,
                            std::string(to_string(verdict)), published.erratum});
    };
    add("shape type", published.shape_type, [](const MethodInfo& info) { return info.shape_type; });
    add("retains the surface", yes_or_no(published.retains_surface),
        [&](const MethodInfo& info) { return yes_or_no(info.retains_surface); });
    add("breaks again", yes_or_no(published.refracture),
        [&](const MethodInfo& info) { return yes_or_no(info.refracture); });
  }
  return table;
}

Table table_2(const ReportInput& input) {
  Table table{.name = "published_times",
              .title = "Table 2: times",
              .notes = {"Absolute times on other hardware cannot be compared: only ratios between "
                        "methods on one machine can. Measured: mean of the stage of that name, "
                        "where the method was run on a shape of that name at that resolution."},
              .columns = {{"shape"},
                          {"method"},
                          {"r"},
                          {"stage"},
                          {"source"},
                          {"printed"},
                          {"published", "s"},
                          {"measured", "s"},
                          {"verdict"},
                          {"erratum"}}};
  const std::vector<PublishedTime> times = published_times();
  for (const std::string& shape : shapes_of(input)) {
    const std::vector<CellRef> cells = broken_cells_of(input, shape);
    for (const PublishedTime& time : times) {
      if (time.shape != lower_case(shape)) continue;
      table.rows.push_back(
          {shape, time.stage.method,
           time.stage.resolution > 0 ? TableCell(std::int64_t{time.stage.resolution}) : TableCell(),
           time.stage.stage, fmt::format("Table 2, {}, {}", time.row, time.column), time.printed,
           time.seconds, number_or_nothing(mean_seconds(cells, time.stage)),
           std::string(to_string(Verdict::not_comparable)), time.erratum});
    }
  }
  return table;
}

Table ratio_table(const ReportInput& input) {
  Table table{
      .name = "published_ratios",
      .title = "Table 2: ratios of times",
      .notes = {"Of two stages on one shape, each on one machine. " + verdict_rule()},
      .columns = {{"shape"}, {"ratio"}, {"published"}, {"measured"}, {"verdict"}, {"erratum"}}};
  const std::vector<PublishedTime> times = published_times();
  const std::vector<PublishedRatio> ratios = published_ratios();
  for (const std::string& shape : shapes_of(input)) {
    const std::vector<CellRef> cells = broken_cells_of(input, shape);
    for (const PublishedRatio& ratio : ratios) {
      const auto published = published_value(ratio, lower_case(shape), times);
      if (!published) continue;
      const auto quotient = [&](std::span<const CellRef> some) -> std::optional<double> {
        const auto over = mean_seconds(some, ratio.over);
        const auto under = mean_seconds(some, ratio.under);
        return over && under && *under > 0 ? std::optional(*over / *under) : std::nullopt;
      };
      const TableCell measured =
          estimate(cells, quotient, input, fmt::format("{} {}", shape, ratio.name));
      table.rows.push_back({shape, ratio.name, *published, measured,
                            std::string(to_string(compare_with_published(*published, measured))),
                            ratio.erratum});
    }
  }
  return table;
}

}  // namespace

ReportItemInfo PaperTables::info() const {
  return {.name = "paper_tables", .title = "Tables of the paper"};
}

ReportSection PaperTables::render(const ReportInput& input) const {
  if (input.cells.empty()) return {};
  ReportSection section;
  for (Table& table : std::vector<Table>{table_1(input), table_2(input), ratio_table(input)}) {
    if (!table.rows.empty()) section.tables.push_back(std::move(table));
  }
  return section;
}

}  // namespace fracbench
