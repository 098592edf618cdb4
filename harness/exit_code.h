#pragma once

#include <exception>

#include "harness/run_result.h"

namespace fracbench {

/// How the program ends, for scripts.
enum class ExitCode : int {
  good = 0,
  internal = 1,          ///< a mistake in the program
  bad_input = 2,         ///< wrong usage, or input or a disk that cannot be used
  regression = 3,        ///< compare found one
  not_measured = 4,      ///< nothing or not everything was measured
  baseline_missing = 5,  ///< compare has nothing to compare with
};

/// Stopped by the user counts as "not everything was measured".
ExitCode exit_code_of(const std::exception& error);
/// Good where every cell has its record, at least one broke or stayed whole, and none was lost to
/// a time limit, to memory or to a crash. What a method cannot do (`invalid`) is a finding.
ExitCode exit_code_of(const RunResult& result);

}  // namespace fracbench
