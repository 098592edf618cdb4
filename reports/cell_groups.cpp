#include "reports/cell_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>

#include "metrics/summary.h"

namespace fracbench {

std::vector<CellGroup> group_cells(const std::vector<CellSummary>& cells) {
  std::map<std::string, std::size_t> shapes;
  std::map<std::string, std::size_t> labels;
  for (const CellSummary& cell : cells) {
    shapes.try_emplace(cell.shape, shapes.size());
    labels.try_emplace(cell.label, labels.size());
  }
  std::map<std::pair<std::size_t, std::size_t>, CellGroup> groups;
  for (const CellSummary& cell : cells) {
    CellGroup& group = groups[{shapes.at(cell.shape), labels.at(cell.label)}];
    group.label = cell.label;
    group.shape = cell.shape;
    group.cells.emplace_back(cell);
  }
  std::vector<CellGroup> result;
  for (auto& [order, group] : groups) result.push_back(std::move(group));
  return result;
}

std::size_t method_place(const ReportInput& input, std::string_view label) {
  std::vector<std::string_view> labels;
  for (const CellSummary& cell : input.cells) {
    if (cell.label == label) break;
    if (std::ranges::find(labels, cell.label) == labels.end()) labels.push_back(cell.label);
  }
  return labels.size();
}

int cut_resolution(const CellSummary& cell) {
  const auto options = nlohmann::json::parse(cell.method_options.text(), nullptr, false);
  if (!options.is_object()) return 0;
  if (const int chosen = options.value("resolution", 0); chosen > 0) return chosen;
  double finest = 0;
  for (const auto& r : options.value("resolutions", nlohmann::json::array())) {
    if (r.is_number()) finest = std::max(finest, r.get<double>());
  }
  return static_cast<int>(finest);
}

std::vector<CellRef> broken_cells(std::span<const CellRef> cells) {
  std::vector<CellRef> result;
  std::ranges::copy_if(cells, std::back_inserter(result),
                       [](const CellSummary& cell) { return cell.status == CellStatus::ok; });
  return result;
}

std::optional<double> value_of(const CellSummary& cell, std::string_view metric) {
  const auto found = std::ranges::find(cell.values, metric, &MetricValue::name);
  if (found == cell.values.end()) return std::nullopt;
  return found->value;
}

std::string unit_of(const CellSummary& cell, std::string_view metric) {
  const auto found = std::ranges::find(cell.values, metric, &MetricValue::name);
  return found == cell.values.end() ? "" : found->unit;
}

std::span<const double> series_of(const CellSummary& cell, std::string_view name) {
  const auto found = std::ranges::find(cell.series, name, &MetricSeries::name);
  if (found == cell.series.end()) return {};
  return found->values;
}

std::vector<double> values_of(std::span<const CellRef> cells, std::string_view metric) {
  std::vector<double> values;
  for (const CellSummary& cell : cells) {
    if (const auto value = value_of(cell, metric)) values.push_back(*value);
  }
  return values;
}

std::vector<std::vector<CellRef>> by_collision(std::span<const CellRef> cells) {
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> numbers;
  std::vector<std::vector<CellRef>> collisions;
  for (const CellSummary& cell : cells) {
    const auto [place, is_new] =
        numbers.try_emplace({cell.shape, cell.family, cell.scenario}, collisions.size());
    if (is_new) collisions.emplace_back();
    collisions[place->second].emplace_back(cell);
  }
  return collisions;
}

CollisionValues::CollisionValues(
    std::span<const std::vector<CellRef>> collisions,
    const std::function<std::optional<double>(const CellSummary&)>& value) {
  for (const std::vector<CellRef>& cells : collisions) {
    std::vector<double>& values = values_.emplace_back();
    for (const CellSummary& cell : cells) {
      if (const auto found = value(cell)) values.push_back(*found);
    }
  }
}

std::vector<double> CollisionValues::of(std::span<const std::size_t> chosen) const {
  std::vector<double> pooled;
  for (const std::size_t c : chosen) {
    pooled.insert(pooled.end(), values_[c].begin(), values_[c].end());
  }
  return pooled;
}

std::vector<TableCell> joint_estimates(std::size_t collisions, const ClusterStatistics& statistics,
                                       const ReportInput& input, std::string_view name) {
  std::vector<std::size_t> all(collisions);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<std::optional<double>> values = statistics(all);
  Random random(derive_seed(input.seed, {"report", name}));
  const auto intervals = joint_cluster_bootstrap(collisions, statistics, input.bootstrap, random);
  std::vector<TableCell> cells(values.size());
  for (std::size_t s = 0; s < values.size(); ++s) {
    if (!values[s] || !std::isfinite(*values[s])) continue;
    if (intervals[s]) {
      cells[s] =
          Estimate{.value = *values[s], .low = intervals[s]->low, .high = intervals[s]->high};
    } else {
      cells[s] = *values[s];
    }
  }
  return cells;
}

TableCell estimate(std::size_t collisions, const ClusterStatistic& statistic,
                   const ReportInput& input, std::string_view name) {
  return joint_estimates(collisions, only(statistic), input, name).front();
}

TableCell estimate(std::span<const CellRef> cells,
                   const std::function<std::optional<double>(std::span<const CellRef>)>& statistic,
                   const ReportInput& input, std::string_view name) {
  const std::vector<std::vector<CellRef>> collisions = by_collision(cells);
  const auto of_chosen = [&](std::span<const std::size_t> chosen) {
    std::vector<CellRef> pooled;
    for (const std::size_t c : chosen) {
      pooled.insert(pooled.end(), collisions[c].begin(), collisions[c].end());
    }
    return statistic(pooled);
  };
  return estimate(collisions.size(), of_chosen, input, name);
}

TableCell estimated_mean(std::span<const CellRef> cells, std::string_view metric,
                         const ReportInput& input) {
  const std::vector<std::vector<CellRef>> collisions = by_collision(cells);
  const CollisionValues values(collisions,
                               [&](const CellSummary& cell) { return value_of(cell, metric); });
  const auto mean = [&](std::span<const std::size_t> chosen) -> std::optional<double> {
    const std::vector<double> pooled = values.of(chosen);
    if (pooled.empty()) return std::nullopt;
    return summarize(pooled).mean;
  };
  return estimate(collisions.size(), mean, input, metric);
}

}  // namespace fracbench
