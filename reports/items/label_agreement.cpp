#include "reports/items/label_agreement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "metrics/summary.h"
#include "reports/cell_groups.h"

namespace fracbench {

namespace {

/// The pairs of one method and shape.
struct Row {
  std::string shape, method, label;
  std::vector<const FractureAgreement*> pairs;

  /// What they have of one quantity.
  template <typename Quantity>
  std::vector<double> values(const Quantity& quantity) const {
    std::vector<double> result;
    for (const FractureAgreement* pair : pairs) {
      if (const std::optional<double> value = quantity(*pair)) result.push_back(*value);
    }
    return result;
  }
  std::vector<double> indices() const {
    return values([](const auto& pair) { return std::optional(pair.partition.adjusted_rand); });
  }
};

std::vector<Row> rows_of(const ReportInput& input) {
  std::vector<Row> rows;
  for (const ReferenceAgreement& pair : input.agreements) {
    const std::string method = pair.other_impact ? pair.label + ", another impact" : pair.label;
    auto row = std::ranges::find_if(
        rows, [&](const Row& r) { return r.shape == pair.shape && r.method == method; });
    if (row == rows.end()) row = rows.insert(rows.end(), {pair.shape, method, pair.label, {}});
    row->pairs.push_back(&pair.agreement);
  }
  return rows;
}

double standard_error(const Summary& s) {
  return s.deviation() / std::sqrt(static_cast<double>(s.count));
}

Table index_table(const std::vector<Row>& rows) {
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
  for (const Row& row : rows) {
    const std::vector<double> indices = row.indices();
    const Summary s = summarize(indices);
    table.rows.push_back({row.shape, row.method, static_cast<std::int64_t>(s.count), s.mean,
                          standard_error(s), quantile(indices, 0.5).value(), s.minimum, s.maximum});
  }
  return table;
}

Table distance_table(const std::vector<Row>& rows) {
  Table table{.name = "reference_distances",
              .title = "How far apart the fractures are",
              .notes = {"Means over the same collisions; docs/metrics.md defines each. 0 for the "
                        "same fragments, but for the matched IoU, which is 1."},
              .columns = {{"shape"},
                          {"method"},
                          {"variation of information", "bit"},
                          {"matched IoU"},
                          {"Chamfer, fracture surfaces", "m"},
                          {"Hausdorff 95 %, fracture surfaces", "m"},
                          {"Chamfer, fragments", "m"}}};
  for (const Row& row : rows) {
    const auto mean = [&](const auto& quantity) {
      const std::vector<double> values = row.values(quantity);
      return number_or_nothing(values.empty() ? std::nullopt
                                              : std::optional(summarize(values).mean));
    };
    using Pair = FractureAgreement;
    using Value = std::optional<double>;
    table.rows.push_back(
        {row.shape, row.method,
         mean([](const Pair& p) -> Value { return p.partition.variation_of_information; }),
         mean([](const Pair& p) -> Value { return p.partition.matched_iou; }),
         mean([](const Pair& p) { return p.surfaces ? Value(p.surfaces->chamfer) : Value(); }),
         mean([](const Pair& p) { return p.surfaces ? Value(p.surfaces->hausdorff_95) : Value(); }),
         mean([](const Pair& p) { return p.fragment_chamfer; })});
  }
  return table;
}

/// Every collision as a dot, the mean over them with its standard error; a figure for each shape.
std::vector<Figure> figures_of(const std::vector<Row>& rows, const ReportInput& input) {
  std::vector<Figure> figures;
  std::string shape;
  for (const Row& row : rows) {
    if (figures.empty() || row.shape != shape) {
      shape = row.shape;
      figures.push_back({.name = "label_agreement_" + file_name_part(shape),
                         .title = "Agreement with bem: " + shape,
                         .notes = {"Faint: single collisions; dots with lines: their mean and its "
                                   "standard error."},
                         .x = {.label = "method"},
                         .y = {.label = "adjusted Rand index"}});
    }
    Figure& figure = figures.back();
    const auto place = static_cast<double>(figure.x.categories.size());
    figure.x.categories.push_back(row.method);
    const std::vector<double> indices = row.indices();
    const Summary s = summarize(indices);
    const double error = standard_error(s);
    const std::size_t colour = method_place(input, row.label);
    FigureSeries single{.name = {}, .colour = colour, .mark = Mark::dots, .faint = true};
    for (std::size_t i = 0; i < indices.size(); ++i) {
      // Beside each other in a fixed pattern, so that equal values do not hide each other.
      single.x.push_back(place + 0.06 * (static_cast<double>(i % 7) - 3));
      single.y.push_back(indices[i]);
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
  const std::vector<Row> rows = rows_of(input);
  if (rows.empty()) return {};
  return {.paragraphs = {},
          .tables = {index_table(rows), distance_table(rows)},
          .figures = figures_of(rows, input)};
}

}  // namespace fracbench
