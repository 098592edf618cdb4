#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <variant>

#include "core/progress.h"
#include "harness/cell_executor.h"
#include "harness/record.h"
#include "harness/workers/worker_process.h"

namespace fracbench {

/// A worker that had to be ended, or that ended without an answer.
struct WorkerLoss {
  CellStatus status = CellStatus::crash;
  std::string reason;
  std::string limit;  ///< the limit that it met, by its name in the suite; empty: none
  CellPhase phase = CellPhase::prepare;
  double seconds = 0;             ///< since the cell was begun
  std::uint64_t peak_memory = 0;  ///< that was seen of the process and its children, bytes
};

struct SupervisionOptions {
  CellLimits limits;
  /// Why the worker must be ended for lack of memory on the machine, given what it has taken; empty
  /// while there is enough. Asked many times a second.
  std::function<std::string(std::uint64_t)> memory_pressure = {};
};

/// Waits for the answer to a cell that was sent to a worker: its record, checked to be one, or how
/// it was lost; a worker that is lost is dead on return. Throws InputError where the method refuses
/// its options and Cancelled where `stop` is asked for; the worker must not be used again then.
std::variant<Record, WorkerLoss> supervise(WorkerProcess& worker, const SupervisionOptions& options,
                                           Progress& progress, const std::stop_token& stop);

}  // namespace fracbench
