#include "harness/cell_executor.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.h"
#include "core/peak_memory.h"
#include "harness/build_info.h"
#include "harness/provenance.h"
#include "metrics/validity.h"

namespace fracbench {

namespace {

using Clock = std::chrono::steady_clock;

std::optional<double> find_value(const Measurement& measurement, std::string_view name) {
  const auto found = std::ranges::find(measurement.values, name, &MetricValue::name);
  if (found == measurement.values.end()) return std::nullopt;
  return found->value;
}

void append(Measurement& all, Measurement more) {
  std::ranges::move(more.values, std::back_inserter(all.values));
  std::ranges::move(more.series, std::back_inserter(all.series));
}

/// Why fragments are not what the method promises; empty where they are.
std::string complaint(const CellResult& cell, const Measurement& measurement,
                      const MethodInfo& method) {
  if (find_value(measurement, "valid").value_or(1) == 0) {
    return check_fragments(cell.body, cell.fragments, cell.threads).describe();
  }
  const double ratio = find_value(measurement, "volume_ratio").value_or(1);
  if (!(std::abs(ratio - 1) <= method.volume_tolerance)) {
    return fmt::format("volume_ratio differs from 1 by {:.3g}, the method promises {:.3g}",
                       ratio - 1, method.volume_tolerance);
  }
  return "";
}

/// Whether a fragment is a mesh at all, with a tag for each face. Others cannot be stored.
bool is_mesh(const Fragment& fragment) {
  const auto count = static_cast<std::int64_t>(fragment.mesh.vertices.size());
  if (fragment.faces.size() != fragment.mesh.faces.size()) return false;
  return std::ranges::all_of(fragment.mesh.faces, [&](const Face& face) {
    return std::ranges::all_of(face, [&](std::int32_t v) { return v >= 0 && v < count; });
  });
}

/// Measures a scene's result with the metrics of the result. What a metric throws is a mistake in
/// it or in the fragments; the others are measured all the same.
void measure(const CellResult& cell, std::span<const std::unique_ptr<Metric>> metrics,
             const MethodInfo& method, CellOutcome& outcome) {
  for (const auto& metric : metrics) {
    const MetricInfo info = metric->info();
    if (info.of_machine) continue;
    try {
      append(outcome.measurement, metric->measure(cell));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      outcome.status = CellStatus::crash;
      outcome.reason = fmt::format("metric '{}': {}", info.name, error.what());
    }
  }
  if (outcome.status != CellStatus::ok) return;
  outcome.reason = complaint(cell, outcome.measurement, method);
  if (!outcome.reason.empty()) outcome.status = CellStatus::invalid;
}

}  // namespace

CellExecutor::CellExecutor(const Plan& plan, const Catalog& catalog, bool alone)
    : plan_(plan),
      catalog_(catalog),
      alone_(alone),
      cache_(plan),
      provenance_(collect_provenance()) {
  provenance_["suite"] = plan.suite.name;
  for (const PlannedMethod& method : plan.methods) {
    options_json_.push_back(method.options.to_json().dump());
  }
}

Record CellExecutor::execute(const Cell& cell, Progress& progress, const std::stop_token& stop) {
  const PlannedShape& shape = plan_.shapes[cell.shape];
  const PlannedScenario& scenario = shape.scenarios[cell.scenario];
  const PlannedMethod& method = plan_.methods[cell.method];
  Record record{.key = cell.key,
                .identity = {.method = method.info.name,
                             .label = method.label,
                             .method_options = options_json_[cell.method],
                             .method_digest = method.info.source_digest,
                             .shape = shape.label,
                             .shape_digest = shape.digest,
                             .family = scenario.scenario.family,
                             .scenario = scenario.name,
                             .scenario_values = to_json(scenario.scenario).dump(),
                             .repeat = cell.repeat,
                             .seed = cell.seed,
                             .prepare_seed = cell.prepare_seed,
                             .threads = plan_.suite.threads_per_cell,
                             .source_digest = build_info().source_digest},
                .outcome = {},
                .cost = {}};
  record.outcome.notes = shape.shape.notes;
  record.cost.provenance = provenance_;
  record.cost.provenance["started"] = utc_now();

  if (alone_) reset_peak_memory();
  StageTimer timer;
  const auto start = Clock::now();
  const auto fail = [&](CellStatus status, std::string reason) {
    record.outcome.status = status;
    record.outcome.reason = std::move(reason);
  };
  Prepared prepared;
  try {
    // Pauses while a stage of its own name runs, so that nothing is left unaccounted for.
    const auto rest = timer.stage("other");
    {
      const auto stage = timer.stage("prepare");
      Random random(cell.prepare_seed);
      Context context{.random = random,
                      .timer = timer,
                      .progress = progress,
                      .stop = stop,
                      .threads = record.identity.threads};
      prepared = cache_.get(cell, context);
    }
    record.cost.prepare_seconds = prepared.seconds;
    if (!prepared.breakable) throw MethodFailure(prepared.failure);
    Random random(cell.seed);
    Context context{.random = random,
                    .timer = timer,
                    .progress = progress,
                    .stop = stop,
                    .threads = record.identity.threads};
    record.outcome.scene =
        catalog_.run_scene(scenario.scenario, *prepared.target, prepared.breakable, context);
    context.stop_if_asked();
    const auto stage = timer.stage("metrics");
    const SceneResult& scene = record.outcome.scene;
    if (scene.impacts.empty()) record.outcome.status = CellStatus::unbroken;
    if (scene.impacts.empty() && !scene.unbroken) {
      record.outcome.notes.emplace_back("nothing touched the target");
    }
    const CellResult result{.body = prepared.target->mesh,
                            .fragments = scene.fragments,
                            .impacts = scene.impacts,
                            .stages = {},
                            .threads = record.identity.threads};
    measure(result, catalog_.metrics, method.info, record.outcome);
    if (const auto lost = std::erase_if(record.outcome.scene.fragments, std::not_fn(is_mesh))) {
      record.outcome.notes.push_back(fmt::format("{} fragments that are no meshes left out", lost));
      if (record.outcome.status == CellStatus::ok) fail(CellStatus::invalid, "no meshes");
    }
  } catch (const Cancelled&) {
    throw;
  } catch (const InputError& error) {
    // Before it was ready, the method did not like its options: those are the user's. Afterwards
    // it did not like what the scene brought.
    if (!prepared.target) {
      throw InputError(
          fmt::format("{} with method '{}': {}", shape.label, method.label, error.what()));
    }
    fail(CellStatus::invalid, error.what());
  } catch (const MethodFailure& failure) {
    fail(CellStatus::invalid, failure.what());
  } catch (const std::bad_alloc&) {
    fail(CellStatus::out_of_memory, "the memory of this process was not enough");
  } catch (const std::exception& error) {
    fail(CellStatus::crash, error.what());
  }
  record.cost.total_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  record.cost.stages = timer.times();
  record.cost.peak_memory = static_cast<double>(peak_memory());
  const CellResult cost{.body = shape.shape.mesh,
                        .fragments = record.outcome.scene.fragments,
                        .impacts = record.outcome.scene.impacts,
                        .stages = record.cost.stages,
                        .total_seconds = record.cost.total_seconds,
                        .peak_memory = record.cost.peak_memory,
                        .threads = record.identity.threads};
  for (const auto& metric : catalog_.metrics) {
    if (metric->info().of_machine) append(record.cost.measurement, metric->measure(cost));
  }
  return record;
}

}  // namespace fracbench
