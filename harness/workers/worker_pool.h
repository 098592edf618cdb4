#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "harness/plan.h"
#include "harness/record.h"
#include "harness/workers/cell_supervisor.h"
#include "harness/workers/worker_spawner.h"

namespace fracbench {

struct WorkerPoolOptions {
  /// Path and arguments of a program that calls serve_cells.
  std::vector<std::string> command = {"/proc/self/exe", "worker"};
  std::size_t idle = 64;               ///< workers that are kept for later cells, at most
  std::uint64_t reserve = 512u << 20;  ///< memory that is to stay free on the machine, bytes
};

/// Measures cells in worker processes, which are kept for other cells of the same shape and method.
/// A worker that fails is replaced. Whatever happens to a worker, its cell gets a record.
class WorkerPool {
 public:
  WorkerPool(const Plan& plan, const Catalog& catalog, WorkerPoolOptions options);

  /// See CellExecutor::execute; from as many threads as one likes. Throws Cancelled when asked to
  /// stop, InputError where the method refuses its options, std::system_error where no process can
  /// be started.
  Record execute(const Cell& cell, Progress& progress, const std::stop_token& stop);

  /// Whether no worker would have to be started beside one that is busy with the same shape and
  /// method.
  bool ready(const Cell& cell) const;

 private:
  using Kind = std::pair<std::size_t, std::size_t>;  ///< shape and method
  struct Idle {
    Kind kind;
    std::unique_ptr<WorkerProcess> worker;
  };

  static Kind kind_of(const Cell& cell) { return {cell.shape, cell.method}; }

  std::string body_key(const Cell& cell) const;
  Record ask(WorkerProcess& worker, const Cell& cell, Progress& progress,
             const std::stop_token& stop, bool& healthy);
  std::unique_ptr<WorkerProcess> take(const Cell& cell);
  void give_back(const Cell& cell, std::unique_ptr<WorkerProcess> worker, bool healthy);
  std::string memory_pressure(const WorkerProcess& worker, std::uint64_t taken);
  Record lost_record(const Cell& cell, const WorkerLoss& loss) const;
  void finish(Record& record, const CellLimits& limits) const;

  const Plan& plan_;
  const Catalog& catalog_;
  const WorkerPoolOptions options_;
  const std::map<std::string, std::string> provenance_;
  const std::uint64_t available_at_start_;
  WorkerSpawner spawner_;  // outlives the workers below

  mutable std::mutex mutex_;                             // guards all that follows
  std::list<Idle> idle_;                                 // the one that was used last at the front
  std::map<Kind, int> busy_;                             // how many
  std::map<const WorkerProcess*, std::uint64_t> taken_;  // memory of busy workers, bytes
  std::map<std::string, WorkerLoss> unprepared_;         // bodies that a worker was lost over
};

}  // namespace fracbench
