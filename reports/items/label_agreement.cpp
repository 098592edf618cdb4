#include "reports/items/label_agreement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "metrics/summary.h"
#include "reports/cell_groups.h"

namespace fracbench {

namespace {

struct Row {
  std::string shape, method, label;
  std::vector<double> index;
};

std::vector<Row> rows_of(const ReportInput& input) {
  std::vector<Row> rows;
  for (const LabelAgreement& pair : input.agreements) {
    const std::string method = pair.other_impact ? pair.label + ", another impact" : pair.label;
    auto row = std::ranges::find_if(
        rows, [&](const Row& r) { return r.shape == pair.shape && r.method == method; });
    if (row == rows.end()) row = rows.insert(rows.end(), {pair.shape, method, pair.label, {}});
    row->index.push_back(pair.index);
  }
  return rows;
}

/// Every collision as a dot, the mean over them with its standard error; a figure for each shape.
std::vector<Figure> figures_of(const std::vector<Row>& rows, const ReportInput& input) {
  std::vector<Figure> figures;
  std::string shape;
  for (const Row& row : rows) {
    if (figures.empty() || row.shape != shape) {
      shape = row.shape;
      figures.push_back({.name = "label_agreement_" + shape,
                         .title = "Agreement with bem: " + shape,
                         .notes = {"Faint: single collisions; dots with lines: their mean and its "
                                   "standard error."},
                         .x = {.label = "method"},
                         .y = {.label = "adjusted Rand index"}});
    }
    Figure& figure = figures.back();
    const auto place = static_cast<double>(figure.x.categories.size());
    figure.x.categories.push_back(row.method);
    const Summary s = summarize(row.index);
    const double error = s.deviation() / std::sqrt(static_cast<double>(s.count));
    const std::size_t colour = method_place(input, row.label);
    FigureSeries single{.name = {}, .colour = colour, .mark = Mark::dots, .faint = true};
    for (std::size_t i = 0; i < row.index.size(); ++i) {
      // Beside each other in a fixed pattern, so that equal values do not hide each other.
      single.x.push_back(place + 0.06 * (static_cast<double>(i % 7) - 3));
      single.y.push_back(row.index[i]);
    }
    figure.series.push_back(std::move(single));
    figure.series.push_back({.name = {},
                             .colour = colour,
                             .mark = Mark::intervals,
                             .x = {place},
                             .y = {s.mean},
                             .low = {s.mean - error},
                             .high = {s.mean + error}});
  }
  return figures;
}

}  // namespace

ReportItemInfo LabelAgreementTable::info() const {
  return {.name = "label_agreement", .title = "Agreement with the reference"};
}

ReportSection LabelAgreementTable::render(const ReportInput& input) const {
  Table table{
      .name = "label_agreement",
      .title = "Which places belong together",
      .notes = {"Adjusted Rand index of the fragments and those of bem under the same impact, at "
                "the samples of a grid of 64^3: 1 for the same fragments, 0 for unrelated ones. "
                "Collisions that both broke the body in. bem under another impact (of each "
                "collision the next one's) is what a prediction has to exceed to know of the "
                "impact at all."},
      .columns = {{"shape"},
                  {"method"},
                  {"collisions"},
                  {"mean"},
                  {"standard error"},
                  {"median"},
                  {"least"},
                  {"most"}}};
  const std::vector<Row> rows = rows_of(input);
  for (const Row& row : rows) {
    const Summary s = summarize(row.index);
    table.rows.push_back({row.shape, row.method, static_cast<std::int64_t>(s.count), s.mean,
                          s.deviation() / std::sqrt(static_cast<double>(s.count)),
                          quantile(row.index, 0.5).value(), s.minimum, s.maximum});
  }
  if (table.rows.empty()) return {};
  return {.paragraphs = {}, .tables = {std::move(table)}, .figures = figures_of(rows, input)};
}

}  // namespace fracbench
