#include "reports/items/representations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/palette.h"
#include "metrics/summary.h"
#include "reports/cell_groups.h"

namespace fracbench {

namespace {

using neural::Representation;
using neural::RepresentationStudy;
using neural::StudyOutcome;

constexpr int kShown = 8;     // patterns of a picture
constexpr int kWidth = 1024;  // of a picture, at least, px
constexpr int kGap = 4;       // between images, px

std::string loss_of(Representation representation) {
  return representation == Representation::labels ? "Dice" : "L2";
}

/// Mean over the patterns, which are independent, with its interval.
TableCell mean_of(const std::vector<double>& values, const ReportInput& input,
                  std::string_view name) {
  return estimate(
      values.size(),
      [&](std::span<const std::size_t> chosen) -> std::optional<double> {
        double sum = 0;
        for (const std::size_t pattern : chosen) sum += values[pattern];
        return sum / static_cast<double>(chosen.size());
      },
      input, name);
}

Table table_of(const RepresentationStudy& study, const ReportInput& input) {
  const neural::StudySettings& s = study.settings;
  Table table{
      .name = "representations",
      .title = "What comes back of divided images that were learned by heart",
      .notes = {fmt::format(
          "{} Voronoi diagrams of {} to {} sites, {} x {} pixels, {} epochs. A small decoder of "
          "its own for each representation, with a trainable code for each diagram. Regions are "
          "read from what it decodes: by value, by what is connected away from lines, by flooding "
          "a distance. Agreement with the true regions: adjusted Rand index, mean over the "
          "diagrams, intervals from resampling them; exact images give the ceiling.",
          s.patterns, s.least_sites, s.most_sites, s.side, s.side, s.epochs)},
      .columns = {{"representation"},
                  {"loss"},
                  {"last loss"},
                  {"agreement"},
                  {"ceiling"},
                  {"regions"},
                  {"true regions"}}};
  for (const StudyOutcome& outcome : study.outcomes) {
    const std::string name(to_string(outcome.representation));
    table.rows.push_back(
        {name, loss_of(outcome.representation), outcome.loss.back(),
         mean_of(outcome.agreement, input, name + " agreement"), summarize(outcome.ceiling).mean,
         mean_of(outcome.regions, input, name + " regions"), summarize(study.true_regions).mean});
  }
  return table;
}

/// Every pattern, for whoever wants the distribution.
Table pattern_table(const RepresentationStudy& study) {
  Table table{.name = "representation_patterns",
              .title = "Every diagram",
              .columns = {{"representation"},
                          {"diagram"},
                          {"agreement"},
                          {"ceiling"},
                          {"regions"},
                          {"true regions"}},
              .in_text = false};
  for (const StudyOutcome& outcome : study.outcomes) {
    for (std::size_t k = 0; k < outcome.agreement.size(); ++k) {
      table.rows.push_back({std::string(to_string(outcome.representation)),
                            static_cast<std::int64_t>(k + 1), outcome.agreement[k],
                            outcome.ceiling[k], outcome.regions[k], study.true_regions[k]});
    }
  }
  return table;
}

Figure loss_figure(const RepresentationStudy& study) {
  Figure figure{.name = "representation_loss",
                .title = "Training loss",
                .notes = {"Losses of different kinds: their sizes cannot be compared."},
                .x = {.label = "epoch"},
                .y = {.label = "mean loss of the epoch", .logarithmic = true}};
  for (const StudyOutcome& outcome : study.outcomes) {
    FigureSeries series{.name = fmt::format("{} ({})", to_string(outcome.representation),
                                            loss_of(outcome.representation)),
                        .colour = figure.series.size()};
    for (std::size_t epoch = 0; epoch < outcome.loss.size(); ++epoch) {
      series.x.push_back(static_cast<double>(epoch + 1));
      series.y.push_back(outcome.loss[epoch]);
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

/// How many diagrams agree at most as well, for each representation.
Figure agreement_figure(const RepresentationStudy& study) {
  Figure figure{.name = "representation_agreement",
                .title = "Agreement of the regions that come back",
                .notes = {"Share of diagrams with at most that agreement."},
                .x = {.label = "adjusted Rand index"},
                .y = {.label = "share of diagrams"}};
  for (const StudyOutcome& outcome : study.outcomes) {
    FigureSeries series{.name = std::string(to_string(outcome.representation)),
                        .colour = figure.series.size()};
    std::vector<double> sorted = outcome.agreement;
    std::ranges::sort(sorted);
    const auto count = static_cast<double>(sorted.size());
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      series.x.insert(series.x.end(), {sorted[k], sorted[k]});
      series.y.insert(series.y.end(),
                      {static_cast<double>(k) / count, static_cast<double>(k + 1) / count});
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

/// The first patterns of one outcome side by side: targets, what was decoded, regions.
Picture picture_of(const StudyOutcome& outcome, const neural::StudySettings& s) {
  const int columns = std::min(kShown, s.patterns);
  const int scale = std::max(1, kWidth / (columns * s.side));
  const int step = scale * s.side + kGap;
  Picture picture(columns * step - kGap, 3 * step - kGap);
  const auto fill = [&](int row, const auto& colour_of) {
    for (int column = 0; column < columns; ++column) {
      for (int y = 0; y < scale * s.side; ++y) {
        for (int x = 0; x < scale * s.side; ++x) {
          const int pixel = (column * s.side + y / scale) * s.side + x / scale;
          const Vec3 colour = colour_of(static_cast<std::size_t>(pixel));
          const int at = (row * step + y) * picture.width + column * step + x;
          for (int k = 0; k < 3; ++k) {
            picture.rgb[static_cast<std::size_t>(3 * at + k)] =
                static_cast<std::uint8_t>(std::lround(255 * std::clamp(colour[k], 0.0, 1.0)));
          }
        }
      }
    }
  };
  const auto grey = [](float value) { return Vec3(value, value, value); };
  fill(0, [&](std::size_t pixel) { return grey(outcome.targets[pixel]); });
  fill(1, [&](std::size_t pixel) { return grey(outcome.decoded[pixel]); });
  fill(2, [&](std::size_t pixel) {
    return fragment_color(static_cast<std::size_t>(outcome.back[pixel]));
  });
  return picture;
}

}  // namespace

ReportItemInfo Representations::info() const {
  return {.name = "representations", .title = "Representations of divided images"};
}

ReportSection Representations::render(const ReportInput& input) const {
  if (!input.study) return {};
  const RepresentationStudy& study = *input.study;
  ReportSection section{.paragraphs = {},
                        .tables = {table_of(study, input), pattern_table(study)},
                        .figures = {agreement_figure(study), loss_figure(study)}};
  for (const StudyOutcome& outcome : study.outcomes) {
    section.pictures.push_back(
        {.name = fmt::format("representation_{}", to_string(outcome.representation)),
         .title = fmt::format("Voronoi diagrams as {}", to_string(outcome.representation)),
         .notes = {"Above what was to be learned, below it what the network decodes, and the "
                   "regions that are read from that."},
         .picture = picture_of(outcome, study.settings)});
  }
  return section;
}

}  // namespace fracbench
