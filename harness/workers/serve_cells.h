#pragma once

#include "harness/catalog.h"

namespace fracbench {

/// Where a worker finds the socket to its supervisor.
inline constexpr int kWorkerSocket = 3;

/// How a worker ends that could not get memory.
inline constexpr int kNoMemoryExitCode = 97;

/// The life of a worker process: measures one cell after another for the supervisor at the other
/// end of the socket, and ends with all its children when the supervisor does. To be called at the
/// start of the process, before any thread is made. Returns the process's exit code: 2 where there
/// is no supervisor.
int serve_cells(const Catalog& catalog);

}  // namespace fracbench
