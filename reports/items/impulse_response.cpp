#include "reports/items/impulse_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>

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
TableCell correlation(const std::vector<Response>& collisions,
                      std::vector<double> Response::*quantity, const ReportInput& input,
                      std::string_view name) {
  const auto statistic = [&](std::span<const std::size_t> chosen) {
    std::vector<double> impulse;
    std::vector<double> answer;
    for (const std::size_t c : chosen) {
      const Response& response = collisions[c];
      impulse.insert(impulse.end(), response.impulse.begin(), response.impulse.end());
      answer.insert(answer.end(), (response.*quantity).begin(), (response.*quantity).end());
    }
    return rank_correlation(impulse, answer);
  };
  return estimate(collisions.size(), statistic, input, name);
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
    if (response_of(cells).impulse.size() < 3) continue;
    std::vector<Response> collisions;
    for (const auto& collision : by_collision(cells)) collisions.push_back(response_of(collision));
    const std::string name = group.shape + " " + group.label;
    table.rows.push_back(
        {group.shape, group.label, static_cast<std::int64_t>(collisions.size()),
         correlation(collisions, &Response::count, input, name + " impulse count"),
         correlation(collisions, &Response::largest, input, name + " impulse largest")});
  }
  return table;
}

/// The impulses of each collision with a shape in the scenes of a family: methods meet the same
/// ones.
struct SceneImpulses {
  std::string shape, family;
  std::vector<double> first = {};   ///< the strongest of each collision, N s
  std::vector<double> second = {};  ///< the one after it; 0 where there is none
};

std::vector<SceneImpulses> impulses_by_scene(const ReportInput& input) {
  std::vector<SceneImpulses> scenes;
  for (const CellGroup& group : group_cells(input.cells)) {
    if (group.label != input.cells.front().label) continue;
    for (const std::vector<CellRef>& collision : by_collision(group.cells)) {
      const CellSummary& cell = collision.front();
      if (cell.impulses.empty()) continue;
      auto scene = std::ranges::find_if(scenes, [&](const SceneImpulses& s) {
        return s.shape == cell.shape && s.family == cell.family;
      });
      if (scene == scenes.end()) scene = scenes.insert(scenes.end(), {cell.shape, cell.family});
      scene->first.push_back(cell.impulses[0]);
      scene->second.push_back(cell.impulses.size() > 1 ? cell.impulses[1] : 0);
    }
  }
  return scenes;
}

Table impulse_table(const std::vector<SceneImpulses>& scenes) {
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
  for (const SceneImpulses& scene : scenes) {
    std::vector<double> second = scene.second;
    std::erase(second, 0.0);
    TableCell mean;
    if (!second.empty()) mean = summarize(second).mean;
    table.rows.push_back({scene.shape, scene.family, static_cast<std::int64_t>(scene.first.size()),
                          summarize(scene.first).mean, mean,
                          static_cast<std::int64_t>(second.size())});
  }
  return table;
}

/// Largest and second largest impulse of every collision (supplement, figure 9).
std::vector<Figure> figures_of(const std::vector<SceneImpulses>& scenes) {
  std::vector<Figure> figures;
  for (const SceneImpulses& scene : scenes) {
    if (scene.first.size() < 2) continue;
    std::vector<std::size_t> order(scene.first.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t c) { return scene.first[c]; });
    FigureSeries first{.name = "largest", .colour = 0, .mark = Mark::dots};
    FigureSeries second{.name = "second largest", .colour = 1, .mark = Mark::dots};
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
      const auto x = static_cast<double>(rank + 1);
      first.x.push_back(x);
      first.y.push_back(scene.first[order[rank]]);
      if (scene.second[order[rank]] == 0) continue;
      second.x.push_back(x);
      second.y.push_back(scene.second[order[rank]]);
    }
    figures.push_back({.name = file_name_part("impulses_" + scene.shape + "_" + scene.family),
                       .title = fmt::format("Impulses of {} scenes: {}", scene.family, scene.shape),
                       .x = {.label = "collision, by its largest impulse"},
                       .y = {.label = "impulse [N s]"},
                       .series = {std::move(first)}});
    if (!second.x.empty()) figures.back().series.push_back(std::move(second));
  }
  return figures;
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
  const std::vector<SceneImpulses> scenes = impulses_by_scene(input);
  ReportSection section{.paragraphs = {}, .tables = {}, .figures = figures_of(groups, input)};
  std::ranges::move(figures_of(scenes), std::back_inserter(section.figures));
  for (Table& table : std::vector<Table>{response_table(groups, input), impulse_table(scenes)}) {
    if (!table.rows.empty()) section.tables.push_back(std::move(table));
  }
  return section;
}

}  // namespace fracbench
