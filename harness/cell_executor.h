#pragma once

#include <map>
#include <stop_token>
#include <string>

#include "core/progress.h"
#include "harness/breakable_cache.h"
#include "harness/plan.h"
#include "harness/record.h"

namespace fracbench {

/// Measures cells of a plan in this process: prepares the body, runs the scene, measures. From as
/// many threads as one likes. What goes wrong in a method ends up in the record's status.
class CellExecutor {
 public:
  /// `alone`: one cell at a time, so that the process's peak memory is that of the cell.
  CellExecutor(const Plan& plan, const Catalog& catalog, bool alone);

  /// Throws Cancelled when asked to stop, and InputError where the method refuses its options.
  Record execute(const Cell& cell, Progress& progress, const std::stop_token& stop);

 private:
  const Plan& plan_;
  const Catalog& catalog_;
  bool alone_;
  BreakableCache cache_;
  std::map<std::string, std::string> provenance_;
  std::vector<std::string> options_json_;  ///< of each method of the plan
};

}  // namespace fracbench
