#include "harness/cell_summary_json.h"

#include <nlohmann/json.hpp>

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

Name name_from_json(const Json& json) { return json.get_ref<const std::string&>(); }

}  // namespace

Json to_json(const CellSummary& cell) {
  Json values = Json::array(), series = Json::array(), stages = Json::array();
  for (const MetricValue& v : cell.values)
    values.push_back({v.name.text(), v.value, v.unit.text()});
  for (const MetricSeries& s : cell.series)
    series.push_back({s.name.text(), s.values, s.unit.text()});
  for (const StageTime& stage : cell.stages) stages.push_back({stage.name.text(), stage.seconds});
  return {{"key", cell.key},
          {"method", cell.method.text()},
          {"label", cell.label.text()},
          {"method_options", cell.method_options.text()},
          {"shape", cell.shape.text()},
          {"family", cell.family.text()},
          {"scenario", cell.scenario},
          {"repeat", cell.repeat},
          {"seed", cell.seed},
          {"status", to_string(cell.status)},
          {"reason", cell.reason},
          {"values", values},
          {"series", series},
          {"stages", stages},
          {"total_seconds", cell.total_seconds},
          {"prepare_seconds", cell.prepare_seconds},
          {"peak_memory", cell.peak_memory},
          {"threads", cell.threads},
          {"impulses", cell.impulses},
          {"breaks", cell.breaks},
          {"cpu", cell.cpu.text()}};
}

CellSummary cell_summary_from_json(const Json& json) {
  CellSummary cell{.key = json.at("key"),
                   .method = name_from_json(json.at("method")),
                   .label = name_from_json(json.at("label")),
                   .method_options = name_from_json(json.at("method_options")),
                   .shape = name_from_json(json.at("shape")),
                   .family = name_from_json(json.at("family")),
                   .scenario = json.at("scenario"),
                   .repeat = json.at("repeat"),
                   .seed = json.at("seed"),
                   .status = parse_cell_status(json.at("status").get<std::string>()).value(),
                   .reason = json.at("reason"),
                   .values = {},
                   .series = {},
                   .stages = {},
                   .total_seconds = json.at("total_seconds"),
                   .prepare_seconds = json.at("prepare_seconds"),
                   .peak_memory = json.at("peak_memory"),
                   .threads = json.at("threads"),
                   .impulses = json.at("impulses"),
                   .breaks = json.at("breaks"),
                   .cpu = name_from_json(json.at("cpu"))};
  cell.values.reserve(json.at("values").size());
  cell.series.reserve(json.at("series").size());
  cell.stages.reserve(json.at("stages").size());
  for (const Json& v : json.at("values"))
    cell.values.push_back({name_from_json(v.at(0)), v.at(1), name_from_json(v.at(2))});
  for (const Json& s : json.at("series"))
    cell.series.push_back({name_from_json(s.at(0)), s.at(1), name_from_json(s.at(2))});
  for (const Json& s : json.at("stages")) cell.stages.push_back({name_from_json(s.at(0)), s.at(1)});
  return cell;
}

}  // namespace fracbench
