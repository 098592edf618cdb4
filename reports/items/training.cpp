#include "reports/items/training.h"

#include <algorithm>
#include <optional>

#include "metrics/summary.h"
#include "reports/cell_groups.h"

namespace fracbench {

namespace {

/// What the cells of one method and shape say of the training that they share.
struct Learned {
  std::string shape, label;
  std::vector<double> loss = {};        // of each epoch
  std::vector<double> ceiling = {};     // of each training pattern, from exact fields
  std::vector<double> decoded = {};     // the same patterns, from decoded ones
  std::vector<double> other_rows = {};  // of each collision, share of random codes
};

std::vector<double> series_ending(const CellSummary& cell, const std::string& end) {
  const auto values = series_of(cell, cell.method + end);
  return {values.begin(), values.end()};
}

std::vector<Learned> learned_by(const ReportInput& input) {
  std::vector<Learned> all;
  for (const CellGroup& group : group_cells(input.cells)) {
    Learned learned{.shape = group.shape, .label = group.label};
    for (const CellSummary& cell : group.cells) {
      if (learned.loss.empty()) learned.loss = series_ending(cell, "_training_loss");
      if (learned.decoded.empty()) {
        learned.ceiling = series_ending(cell, "_round_trip");
        learned.decoded = series_ending(cell, "_decoded");
      }
      std::ranges::copy(series_ending(cell, "_other_rows"), std::back_inserter(learned.other_rows));
    }
    if (!learned.loss.empty()) all.push_back(std::move(learned));
  }
  return all;
}

TableCell mean_of(const std::vector<double>& values) {
  return number_or_nothing(values.empty() ? std::nullopt : std::optional(summarize(values).mean));
}

Table table_of(const std::vector<Learned>& all) {
  Table table{
      .name = "training",
      .title = "What was learned",
      .notes = {"Labels of training patterns and their fragments, adjusted Rand index: from the "
                "exact fields through the same segmentation (the ceiling), and from the fields "
                "that the network decodes. Codes that choose otherwise: share of random codes that "
                "would have led to another row of the codebook, mean over the collisions."},
      .columns = {{"shape"},
                  {"method"},
                  {"epochs"},
                  {"last loss"},
                  {"patterns judged"},
                  {"ceiling"},
                  {"decoded"},
                  {"decoded, of the ceiling", "%"},
                  {"at 0.9 of their own ceiling"},
                  {"codes that choose otherwise", "%"}}};
  for (const Learned& learned : all) {
    TableCell share;
    TableCell reached;
    const bool judged =
        !learned.decoded.empty() && learned.decoded.size() == learned.ceiling.size();
    if (judged) {
      const double ceiling = summarize(learned.ceiling).mean;
      if (ceiling > 0) share = 100 * summarize(learned.decoded).mean / ceiling;
      std::int64_t count = 0;
      for (std::size_t i = 0; i < learned.decoded.size(); ++i) {
        count += learned.decoded[i] >= 0.9 * learned.ceiling[i];
      }
      reached = count;
    }
    TableCell chance;
    if (!learned.other_rows.empty()) chance = 100 * summarize(learned.other_rows).mean;
    table.rows.push_back(
        {learned.shape, learned.label, static_cast<std::int64_t>(learned.loss.size()),
         learned.loss.back(), static_cast<std::int64_t>(learned.decoded.size()),
         mean_of(learned.ceiling), mean_of(learned.decoded), share, reached, chance});
  }
  return table;
}

Table loss_table(const std::vector<Learned>& all) {
  Table table{.name = "training_loss",
              .title = "Training loss",
              .columns = {{"shape"}, {"method"}, {"epoch"}, {"loss"}},
              .in_text = false};
  for (const Learned& learned : all) {
    for (std::size_t i = 0; i < learned.loss.size(); ++i) {
      table.rows.push_back(
          {learned.shape, learned.label, static_cast<std::int64_t>(i + 1), learned.loss[i]});
    }
  }
  return table;
}

std::vector<Figure> figures_of(const std::vector<Learned>& all, const ReportInput& input) {
  std::vector<Figure> figures;
  std::string shape;
  for (const Learned& learned : all) {
    if (figures.empty() || learned.shape != shape) {
      shape = learned.shape;
      figures.push_back({.name = "training_loss_" + file_name_part(shape),
                         .title = "Training loss: " + shape,
                         .x = {.label = "epoch"},
                         .y = {.label = "mean loss of the epoch", .logarithmic = true}});
    }
    FigureSeries series{.name = learned.label, .colour = method_place(input, learned.label)};
    for (std::size_t i = 0; i < learned.loss.size(); ++i) {
      series.x.push_back(static_cast<double>(i + 1));
      series.y.push_back(learned.loss[i]);
    }
    figures.back().series.push_back(std::move(series));
  }
  return figures;
}

}  // namespace

ReportItemInfo Training::info() const { return {.name = "training", .title = "Training"}; }

ReportSection Training::render(const ReportInput& input) const {
  const std::vector<Learned> all = learned_by(input);
  if (all.empty()) return {};
  return {.paragraphs = {},
          .tables = {table_of(all), loss_table(all)},
          .figures = figures_of(all, input)};
}

}  // namespace fracbench
