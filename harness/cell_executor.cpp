#include "harness/cell_executor.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <new>
#include <optional>

#include "core/error.h"
#include "core/peak_memory.h"
#include "harness/cell_record.h"
#include "harness/provenance.h"
#include "metrics/validity.h"

namespace fracbench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kWarmUpStage = "warm_up";

std::optional<double> find_value(const Measurement& measurement, std::string_view name) {
  const auto found = std::ranges::find(measurement.values, name, &MetricValue::name);
  if (found == measurement.values.end()) return std::nullopt;
  return found->value;
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

CellExecutor::CellExecutor(const Plan& plan, const Catalog& catalog, bool alone,
                           std::function<void(CellPhase)> phase)
    : plan_(plan),
      catalog_(catalog),
      alone_(alone),
      phase_(std::move(phase)),
      cache_(plan),
      provenance_(collect_provenance()) {}

void CellExecutor::enter(CellPhase phase) const {
  if (phase_) phase_(phase);
}

SceneResult CellExecutor::run_scene(const Cell& cell, const Prepared& prepared, StageTimer& timer,
                                    Progress& progress, const std::stop_token& stop,
                                    CellOutcome* outcome) const {
  if (!prepared.breakable) throw MethodFailure(prepared.failure);
  Random random(cell.seed);
  std::vector<Finding> findings;
  Context context{.random = random,
                  .timer = timer,
                  .progress = progress,
                  .stop = stop,
                  .threads = plan_.suite.threads_per_cell,
                  .device = plan_.suite.device,
                  .notes = outcome ? &outcome->notes : nullptr,
                  .findings = &findings};
  SceneResult result =
      catalog_.run_scene(plan_.shapes[cell.shape].scenarios[cell.scenario].scenario,
                         *prepared.target, prepared.breakable, context);
  context.stop_if_asked();
  if (outcome) {
    for (Finding& finding : findings) {
      outcome->measurement.series.push_back(
          {std::move(finding.name), std::move(finding.values), std::move(finding.unit)});
    }
  }
  return result;
}

void CellExecutor::warm_up(const Cell& cell, const Prepared& prepared, StageTimer& timer,
                           Progress& progress, const std::stop_token& stop) const {
  if (!prepared.fresh) return;
  const auto stage = timer.stage(kWarmUpStage);
  for (int k = 0; k < plan_.suite.warm_up; ++k) {
    enter(CellPhase::warm_up);
    StageTimer nobodys;
    run_scene(cell, prepared, nobodys, progress, stop, nullptr);
  }
}

Record CellExecutor::execute(const Cell& cell, Progress& progress, const std::stop_token& stop) {
  const PlannedShape& shape = plan_.shapes[cell.shape];
  const PlannedMethod& method = plan_.methods[cell.method];
  Record record = begin_record(plan_, cell, provenance_);

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
      enter(CellPhase::prepare);
      Random random(cell.prepare_seed);
      Context context{.random = random,
                      .timer = timer,
                      .progress = progress,
                      .stop = stop,
                      .threads = record.identity.threads,
                      .device = plan_.suite.device};
      prepared = cache_.get(cell, context);
    }
    record.cost.prepare_seconds = prepared.seconds;
    warm_up(cell, prepared, timer, progress, stop);
    enter(CellPhase::measure);
    record.outcome.scene = run_scene(cell, prepared, timer, progress, stop, &record.outcome);
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
  if (const auto warm = std::ranges::find(record.cost.stages, kWarmUpStage, &StageTime::name);
      warm != record.cost.stages.end()) {
    record.cost.total_seconds -= warm->seconds;
    record.cost.stages.erase(warm);
  }
  record.cost.peak_memory = static_cast<double>(peak_memory());
  measure_cost(record, shape.shape.mesh, catalog_.metrics);
  return record;
}

}  // namespace fracbench
