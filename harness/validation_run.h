#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "harness/exit_code.h"
#include "harness/runner.h"
#include "methods/validation.h"

namespace fracbench {

/// One line of the accuracy table, or why there is none.
struct AccuracyRow {
  std::string group;  ///< name of the case that gave it
  Accuracy accuracy;
  /// Why the case gave nothing; expected, computed and tolerance are NaN then.
  std::string failure = {};

  bool pass() const { return failure.empty() && accuracy.pass(); }
};

/// What a method's validation has shown so far.
struct ValidationRun {
  std::vector<AccuracyRow> rows;  ///< in the order of the cases
  std::size_t cases = 0;          ///< that were asked for
  std::size_t done = 0;
  bool stopped = false;  ///< somebody asked to stop before the end

  std::size_t failed() const;
};

struct ValidationOptions {
  std::uint64_t seed = 1;
  int threads = 1;
  std::stop_token stop = {};
  /// How far it is; a cell is a case. Some times a second.
  std::function<void(const RunProgress&)> progress = {};
  /// Called after each case, so that nothing is lost when the program is ended.
  std::function<void(const ValidationRun&)> case_done = {};
};

/// The cases of these names, in the method's order; no names: all. Throws InputError for a name
/// that is not there, with the nearest one; `method` is what messages call it.
std::vector<ValidationCase> select_cases(std::vector<ValidationCase> cases,
                                         std::span<const std::string> names,
                                         std::string_view method);

/// Runs the cases one after the other. A case that throws (MethodFailure or anything else but
/// Cancelled) gives a row that failed, with its reason. The random numbers of a case depend on the
/// seed and its name only.
ValidationRun run_validation(std::span<const ValidationCase> cases,
                             const ValidationOptions& options);

/// Good where every row passed; a failed tolerance is a regression, stopping is not measured.
ExitCode exit_code_of(const ValidationRun& run);

}  // namespace fracbench
