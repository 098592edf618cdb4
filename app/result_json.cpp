#include "app/result_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/command.h"
#include "metrics/registry.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kBytesPerMegabyte = 1e6;

/// The value of this name, null where no metric gives it.
Json value_of(const Measurement& measurement, std::string_view name) {
  const auto found = std::ranges::find(measurement.values, name, &MetricValue::name);
  return found == measurement.values.end() ? Json() : Json(found->value);
}

Json truth_of(const Measurement& measurement, std::string_view name) {
  const Json value = value_of(measurement, name);
  return value.is_null() ? value : Json(value.get<double>() != 0);
}

void require_finite(const Json& value) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    throw std::logic_error("a number that JSON does not have in the output");
  }
  if (value.is_structured()) {
    for (const Json& item : value) require_finite(item);
  }
}

}  // namespace

Json result_json(const CellResult& cell) {
  Measurement all;
  Json by_metric = Json::object();
  for (const auto& metric : metrics()) {
    const Measurement measured = metric->measure(cell);
    Json& group = by_metric[metric->info().name] = Json::object();
    for (const MetricValue& value : measured.values) group[value.name] = value.value;
    for (const MetricSeries& series : measured.series) group[series.name] = series.values;
    all.values.insert(all.values.end(), measured.values.begin(), measured.values.end());
    all.series.insert(all.series.end(), measured.series.begin(), measured.series.end());
  }
  const Json valid = truth_of(all, "valid");
  Json result;
  result["status"] = valid == false ? "invalid" : cell.fragments.size() < 2 ? "unbroken" : "ok";
  result["fragment_count"] = cell.fragments.size();
  for (const char* name : {"volume_ratio", "surface_retention"}) result[name] = value_of(all, name);
  for (const char* name : {"closed", "disjoint"}) result[name] = truth_of(all, name);
  const auto volumes = std::ranges::find(all.series, "fragment_volume", &MetricSeries::name);
  result["volumes"] = volumes == all.series.end() ? Json::array() : Json(volumes->values);
  result["stage_seconds"] = Json::object();
  for (const StageTime& stage : cell.stages) result["stage_seconds"][stage.name] = stage.seconds;
  result["total_seconds"] = cell.total_seconds;
  result["peak_memory_mb"] = cell.peak_memory / kBytesPerMegabyte;
  result["metrics"] = by_metric;
  return result;
}

std::string describe_result(const Json& result) {
  const auto yes = [](const Json& value) {
    return value.is_null() ? "not known" : value.get<bool>() ? "yes" : "no";
  };
  const auto number = [](const Json& value) {
    return value.is_null() ? std::string("not known") : fmt::format("{:.15g}", value.get<double>());
  };
  std::string text;
  text += fmt::format("status             {}\n", result["status"].get<std::string>());
  text += fmt::format("fragments          {}\n", result["fragment_count"].get<std::size_t>());
  text += fmt::format("volume ratio       {}\n", number(result["volume_ratio"]));
  text += fmt::format("surface retention  {}\n", number(result["surface_retention"]));
  text +=
      fmt::format("closed, disjoint   {}, {}\n", yes(result["closed"]), yes(result["disjoint"]));
  text += fmt::format("time               {:.3f} s:", result["total_seconds"].get<double>());
  for (const auto& [stage, seconds] : result["stage_seconds"].items()) {
    text += fmt::format(" {} {:.3f}", stage, seconds.get<double>());
  }
  return text + "\n";
}

void print_json(const Json& value) {
  require_finite(value);
  fmt::print("{}\n", value.dump(2));
}

}  // namespace fracbench
