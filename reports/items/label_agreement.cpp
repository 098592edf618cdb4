#include "reports/items/label_agreement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "metrics/summary.h"

namespace fracbench {

namespace {

struct Row {
  std::string shape, method;
  std::vector<double> index;
};

std::vector<Row> rows_of(const ReportInput& input) {
  std::vector<Row> rows;
  for (const LabelAgreement& pair : input.agreements) {
    const std::string method = pair.other_impact ? pair.label + ", another impact" : pair.label;
    auto row = std::ranges::find_if(
        rows, [&](const Row& r) { return r.shape == pair.shape && r.method == method; });
    if (row == rows.end()) row = rows.insert(rows.end(), {pair.shape, method, {}});
    row->index.push_back(pair.index);
  }
  return rows;
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
  for (const Row& row : rows_of(input)) {
    const Summary s = summarize(row.index);
    table.rows.push_back({row.shape, row.method, static_cast<std::int64_t>(s.count), s.mean,
                          s.deviation() / std::sqrt(static_cast<double>(s.count)),
                          quantile(row.index, 0.5).value(), s.minimum, s.maximum});
  }
  if (table.rows.empty()) return {};
  return {.paragraphs = {}, .tables = {std::move(table)}};
}

}  // namespace fracbench
