#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "harness/exit_code.h"
#include "harness/runner.h"

namespace fracbench {

/// How preparing one body went.
struct PreparedRow {
  std::string shape;
  std::string method;
  double seconds = 0;
  std::string failure;  ///< why the method gave up; empty where it did not
};

struct PrepareResult {
  std::vector<PreparedRow> rows;  ///< one for each shape, method and material
  std::size_t bodies = 0;         ///< that were asked for
};

struct PrepareOptions {
  std::stop_token stop = {};
  std::function<void(const RunProgress&)> progress = {};  ///< a cell is a body
};

/// Prepares every body that the plan's cells need, one after the other, and lets it go again: what
/// it takes, and which methods give up on which shapes. Throws InputError where a method refuses
/// its options or its learning data is not there.
PrepareResult prepare_methods(const Plan& plan, const PrepareOptions& options);

/// Good where every body was prepared.
ExitCode exit_code_of(const PrepareResult& result);

/// An array of "shape", "method", "seconds", "prepared" and, where it failed, "reason".
nlohmann::ordered_json to_json(const PrepareResult& result);

}  // namespace fracbench
