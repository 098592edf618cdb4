#include "harness/workers/worker_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/available_memory.h"
#include "core/error.h"
#include "harness/breakable_cache.h"
#include "harness/cell_record.h"
#include "harness/provenance.h"
#include "harness/workers/cell_request.h"
#include "harness/workers/limits_met.h"

namespace fracbench {

namespace {

constexpr double kMebi = 1 << 20;

/// After these the process is as good as before. The others may have left it without memory or in
/// the middle of something.
bool leaves_it_healthy(CellStatus status) {
  return status == CellStatus::ok || status == CellStatus::unbroken ||
         status == CellStatus::invalid;
}

}  // namespace

WorkerPool::WorkerPool(const Plan& plan, const Catalog& catalog, WorkerPoolOptions options)
    : plan_(plan),
      catalog_(catalog),
      options_(std::move(options)),
      provenance_(collect_provenance()),
      available_at_start_(available_memory()),
      spawner_(options_.command) {}

std::string WorkerPool::body_key(const Cell& cell) const {
  return BreakableCache::key(cell,
                             plan_.shapes[cell.shape].scenarios[cell.scenario].scenario.material);
}

bool WorkerPool::ready(const Cell& cell) const {
  const std::scoped_lock lock(mutex_);
  const Kind kind = kind_of(cell);
  const auto busy = busy_.find(kind);
  if (busy == busy_.end() || busy->second == 0) return true;
  return std::ranges::find(idle_, kind, &Idle::kind) != idle_.end();
}

Record WorkerPool::execute(const Cell& cell, Progress& progress, const std::stop_token& stop) {
  const std::string body = body_key(cell);
  {
    const std::scoped_lock lock(mutex_);
    if (const auto lost = unprepared_.find(body); lost != unprepared_.end()) {
      WorkerLoss loss = lost->second;
      loss.seconds = 0;
      return lost_record(cell, loss);
    }
    ++busy_[kind_of(cell)];
  }
  std::unique_ptr<WorkerProcess> worker;
  bool healthy = false;
  try {
    worker = take(cell);
    Record record = ask(*worker, cell, progress, stop, healthy);
    give_back(cell, std::move(worker), healthy);
    return record;
  } catch (...) {
    give_back(cell, std::move(worker), false);
    throw;
  }
}

Record WorkerPool::ask(WorkerProcess& worker, const Cell& cell, Progress& progress,
                       const std::stop_token& stop, bool& healthy) {
  const PlannedMethod& method = plan_.methods[cell.method];
  worker.send({MessageKind::cell, encode_cell(plan_, cell)});
  const SupervisionOptions options{
      .limits = method.limits,
      .memory_pressure = [&](std::uint64_t taken) { return memory_pressure(worker, taken); }};
  auto answer = supervise(worker, options, progress, stop);
  if (auto* record = std::get_if<Record>(&answer)) {
    if (record->key == cell.key && record->identity == identity_of(plan_, cell)) {
      healthy = leaves_it_healthy(record->outcome.status);
      finish(*record, method.limits);
      return std::move(*record);
    }
    worker.kill();
    answer = WorkerLoss{.reason = "the answer is the record of another cell",
                        .limit = "",
                        .phase = CellPhase::measure};
  }
  const WorkerLoss& loss = std::get<WorkerLoss>(answer);
  if (loss.phase == CellPhase::prepare) {
    // The other cells of this body would be lost in the same way, each after as long a time.
    const std::scoped_lock lock(mutex_);
    unprepared_.emplace(body_key(cell), loss);
  }
  return lost_record(cell, loss);
}

std::unique_ptr<WorkerProcess> WorkerPool::take(const Cell& cell) {
  {
    const std::scoped_lock lock(mutex_);
    const auto known = std::ranges::find(idle_, kind_of(cell), &Idle::kind);
    if (known != idle_.end()) {
      auto worker = std::move(known->worker);
      idle_.erase(known);
      return worker;
    }
  }
  const double limit = plan_.methods[cell.method].limits.memory_mb * kMebi;
  const auto memory = limit > 0 ? static_cast<std::uint64_t>(limit) : available_at_start_;
  auto worker = spawner_.start();
  worker->send({MessageKind::job, encode_job(plan_, cell, memory)});
  return worker;
}

void WorkerPool::give_back(const Cell& cell, std::unique_ptr<WorkerProcess> worker, bool healthy) {
  std::list<Idle> ended;  // outside the lock: the end of a large process takes a while
  const std::scoped_lock lock(mutex_);
  --busy_[kind_of(cell)];
  if (!worker) return;
  taken_.erase(worker.get());
  idle_.push_front({kind_of(cell), std::move(worker)});
  if (!healthy) ended.splice(ended.end(), idle_, idle_.begin());
  while (idle_.size() > options_.idle) ended.splice(ended.end(), idle_, std::prev(idle_.end()));
}

std::string WorkerPool::memory_pressure(const WorkerProcess& worker, std::uint64_t taken) {
  std::list<Idle> ended;
  const std::scoped_lock lock(mutex_);
  taken_[&worker] = taken;
  const std::uint64_t left = available_memory();
  if (left >= options_.reserve) return "";
  if (!idle_.empty()) {
    ended.splice(ended.end(), idle_, std::prev(idle_.end()));
    return "";
  }
  const auto largest =
      std::ranges::max_element(taken_, {}, [](const auto& entry) { return entry.second; });
  if (largest->first != &worker) return "";
  return fmt::format("the memory of this machine was not enough: {:.0f} MiB taken, {:.0f} MiB left",
                     static_cast<double>(taken) / kMebi, static_cast<double>(left) / kMebi);
}

Record WorkerPool::lost_record(const Cell& cell, const WorkerLoss& loss) const {
  Record record = begin_record(plan_, cell, provenance_);
  record.outcome.status = loss.status;
  record.outcome.reason = loss.reason;
  record.cost.total_seconds = loss.seconds;
  record.cost.stages = {{"other", loss.seconds}};
  record.cost.peak_memory = static_cast<double>(loss.peak_memory);
  measure_cost(record, plan_.shapes[cell.shape].shape.mesh, catalog_.metrics);
  finish(record, plan_.methods[cell.method].limits);
  if (!loss.limit.empty()) note_limit_met(record, loss.limit);
  return record;
}

void WorkerPool::finish(Record& record, const CellLimits& limits) const {
  note_limits(record, limits);
  record.cost.provenance["isolation"] = "worker process";
}

}  // namespace fracbench
