#include "harness/cell_record.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "harness/build_info.h"
#include "harness/provenance.h"

namespace fracbench {

CellIdentity identity_of(const Plan& plan, const Cell& cell) {
  const PlannedShape& shape = plan.shapes[cell.shape];
  const PlannedScenario& scenario = shape.scenarios[cell.scenario];
  const PlannedMethod& method = plan.methods[cell.method];
  return {.method = method.info.name,
          .label = method.label,
          .method_options = method.options.to_json().dump(),
          .method_digest = method.info.source_digest,
          .shape = shape.label,
          .shape_digest = shape.digest,
          .family = scenario.scenario.family,
          .scenario = scenario.name,
          .scenario_values = to_json(scenario.scenario).dump(),
          .repeat = cell.repeat,
          .seed = cell.seed,
          .prepare_seed = cell.prepare_seed,
          .threads = plan.suite.threads_per_cell,
          .source_digest = build_info().source_digest};
}

Record begin_record(const Plan& plan, const Cell& cell,
                    std::map<std::string, std::string> provenance) {
  Record record{.key = cell.key, .identity = identity_of(plan, cell), .outcome = {}, .cost = {}};
  record.outcome.notes = plan.shapes[cell.shape].shape.notes;
  record.cost.provenance = std::move(provenance);
  record.cost.provenance["suite"] = plan.suite.name;
  record.cost.provenance["started"] = utc_now();
  return record;
}

void measure_cost(Record& record, const TriangleMesh& body,
                  std::span<const std::unique_ptr<Metric>> metrics) {
  const CellResult cost{.body = body,
                        .fragments = record.outcome.scene.fragments,
                        .impacts = record.outcome.scene.impacts,
                        .stages = record.cost.stages,
                        .total_seconds = record.cost.total_seconds,
                        .peak_memory = record.cost.peak_memory,
                        .threads = record.identity.threads};
  for (const auto& metric : metrics) {
    if (metric->info().of_machine) append(record.cost.measurement, metric->measure(cost));
  }
}

void append(Measurement& all, Measurement more) {
  std::ranges::move(more.values, std::back_inserter(all.values));
  std::ranges::move(more.series, std::back_inserter(all.series));
}

}  // namespace fracbench
