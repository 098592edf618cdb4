#include "harness/cost_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/record_store.h"
#include "harness/summary_cache.h"

namespace fracbench {

void CostModel::add(const std::string& shape, const std::string& label, double seconds,
                    std::span<const StageTime> stages) {
  double body = 0;
  for (const StageTime& stage : stages) {
    if (stage.name == "prepare") body = std::min(stage.seconds, seconds);
  }
  for (Measured* measured : {&by_shape_[{shape, label}], &by_label_[label]}) {
    measured->sum += seconds - body;
    ++measured->count;
    measured->body = std::max(measured->body, body);
  }
}

std::optional<double> CostModel::seconds(const std::string& shape, const std::string& label,
                                         std::size_t cells) const {
  const auto many = static_cast<double>(cells);
  const auto exact = by_shape_.find({shape, label});
  if (exact != by_shape_.end()) return many * exact->second.mean();
  const auto alike = by_label_.find(label);
  if (alike == by_label_.end()) return std::nullopt;
  return cells == 0 ? 0 : many * alike->second.mean() + alike->second.body;
}

std::string CostEstimate::describe() const {
  std::string text = fmt::format("{} cell{}", cells, cells == 1 ? "" : "s");
  if (there > 0) text += fmt::format(", {} of them done", there);
  const std::size_t rest = cells - there;
  if (rest == 0) return text;
  const std::string with = fmt::format("with {} job{}", jobs, jobs == 1 ? "" : "s");
  if (unknown == rest) {
    return text + "; how long they take is unknown until the first cell of each kind has run";
  }
  text += fmt::format("; about {} for the rest {}", describe_seconds(seconds), with);
  if (unknown > 0) {
    text +=
        fmt::format(", and an unknown time for {} cells of a kind that has not run yet", unknown);
  }
  return text;
}

nlohmann::ordered_json CostEstimate::as_json() const {
  return {{"cells", cells},
          {"found", there},
          {"unknown", unknown},
          {"seconds", seconds},
          {"jobs", jobs}};
}

CostEstimate estimate_cost(const Plan& plan, const std::filesystem::path& folder, int jobs) {
  CostEstimate estimate{.cells = plan.cells.size(), .jobs = jobs};
  CostModel model;
  std::set<std::string> there;
  SummaryCache cache(folder);
  for (const std::filesystem::path& file : list_records(folder)) {
    try {
      const CellSummary summary = cache.read(file);
      model.add(summary.shape, summary.label, summary.total_seconds, summary.stages);
      there.insert(file.stem().string());
    } catch (const DataError&) {
      // The run itself will say so and redo it.
    }
  }
  std::map<std::pair<std::string, std::string>, std::size_t> missing;
  for (const Cell& cell : plan.cells) {
    if (there.contains(cell.key)) {
      ++estimate.there;
    } else {
      ++missing[{plan.shapes[cell.shape].label, plan.methods[cell.method].label}];
    }
  }
  for (const auto& [kind, count] : missing) {
    const auto seconds = model.seconds(kind.first, kind.second, count);
    if (!seconds) estimate.unknown += count;
    estimate.seconds += seconds.value_or(0) / jobs;
  }
  return estimate;
}

std::string describe_seconds(double seconds) {
  // Records are not trusted with times that a whole number has no room for.
  constexpr double kLongest = 1e12;
  if (!(seconds >= 0 && seconds <= kLongest)) return "an unknown time";
  const auto total = static_cast<long long>(std::ceil(seconds));
  if (total < 60) return fmt::format("{} s", total);
  if (total < 3600) return fmt::format("{} min {} s", total / 60, total % 60);
  if (total < 86400) return fmt::format("{} h {} min", total / 3600, total / 60 % 60);
  const auto days = total / 86400;
  return fmt::format("{} day{} {} h", days, days == 1 ? "" : "s", total / 3600 % 24);
}

}  // namespace fracbench
