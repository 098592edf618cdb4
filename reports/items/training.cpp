#include "reports/items/training.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

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
  std::size_t shapes = 1;               // whose fractures the model learned

  bool judged() const { return !decoded.empty() && decoded.size() == ceiling.size(); }
  /// Mean agreement of decoded patterns, in % of that of exact fields.
  std::optional<double> of_ceiling() const {
    if (!judged()) return std::nullopt;
    const double exact = summarize(ceiling).mean;
    if (exact <= 0) return std::nullopt;
    return 100 * summarize(decoded).mean / exact;
  }
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
      if (const auto count = series_ending(cell, "_shapes"); !count.empty()) {
        learned.shapes = static_cast<std::size_t>(count.front());
      }
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
                  {"shapes in the model"},
                  {"epochs"},
                  {"last loss"},
                  {"patterns judged"},
                  {"ceiling"},
                  {"decoded"},
                  {"decoded, of the ceiling", "%"},
                  {"at 0.9 of their own ceiling"},
                  {"codes that choose otherwise", "%"}}};
  for (const Learned& learned : all) {
    TableCell reached;
    if (learned.judged()) {
      std::int64_t count = 0;
      for (std::size_t i = 0; i < learned.decoded.size(); ++i) {
        count += learned.decoded[i] >= 0.9 * learned.ceiling[i];
      }
      reached = count;
    }
    TableCell chance;
    if (!learned.other_rows.empty()) chance = 100 * summarize(learned.other_rows).mean;
    table.rows.push_back({learned.shape, learned.label, static_cast<std::int64_t>(learned.shapes),
                          static_cast<std::int64_t>(learned.loss.size()), learned.loss.back(),
                          static_cast<std::int64_t>(learned.decoded.size()),
                          mean_of(learned.ceiling), mean_of(learned.decoded),
                          number_or_nothing(learned.of_ceiling()), reached, chance});
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

/// What comes back of the training patterns of a shape against the number of shapes that the model
/// learned (section 6.6 of the paper); nothing where that is the same everywhere.
std::vector<Figure> figure_by_shapes(const std::vector<Learned>& all) {
  Figure figure{
      .name = "quality_by_shapes",
      .title = "One model for several shapes",
      .notes = {"Labels of decoded training patterns against the fragments (adjusted Rand "
                "index), in percent of what exact fields give back."},
      .x = {.label = "shapes in the model"},
      .y = {.label = "decoded, of the ceiling [%]"}};
  std::set<std::size_t> counts;
  std::map<std::string, std::map<std::size_t, double>> curves;
  for (const Learned& learned : all) {
    const auto quality = learned.of_ceiling();
    if (!quality) continue;
    counts.insert(learned.shapes);
    // Of several methods on one shape with as many shapes the first.
    curves[learned.shape].try_emplace(learned.shapes, *quality);
  }
  if (counts.size() < 2) return {};
  for (const auto& [shape, curve] : curves) {
    FigureSeries series{.name = shape, .colour = figure.series.size()};
    for (const auto& [count, quality] : curve) {
      series.x.push_back(static_cast<double>(count));
      series.y.push_back(quality);
    }
    figure.series.push_back(std::move(series));
  }
  return {figure};
}

}  // namespace

ReportItemInfo Training::info() const { return {.name = "training", .title = "Training"}; }

ReportSection Training::render(const ReportInput& input) const {
  const std::vector<Learned> all = learned_by(input);
  if (all.empty()) return {};
  std::vector<Figure> figures = figures_of(all, input);
  std::ranges::move(figure_by_shapes(all), std::back_inserter(figures));
  return {
      .paragraphs = {}, .tables = {table_of(all), loss_table(all)}, .figures = std::move(figures)};
}

}  // namespace fracbench
