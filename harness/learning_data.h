#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/exit_code.h"
#include "harness/learning_index.h"
#include "harness/runner.h"

namespace fracbench {

/// What came of making learning data.
struct LearningResult {
  RunResult run;                       ///< the collisions are the cells
  std::optional<LearningIndex> index;  ///< none where not all collisions have their record
  /// A line for each shape that too few collisions broke, with the numbers and the way out.
  std::vector<std::string> shortages;
};

/// Makes the collisions of a plan (make_learning_plan) whose records are not in the folder yet, and
/// the index of all. May be killed at any moment and called again, like run_suite; the index is the
/// same bytes for any number of jobs and interruptions. Shapes that the folder's index has from
/// another part of the same suite stay in it, and a folder with fewer collisions of the same kind
/// is continued. Throws InputError for a folder that cannot be used.
LearningResult make_learning_data(const Plan& plan, const LearningSplit& split,
                                  const Catalog& catalog, const RunOptions& options);

/// Whether the folder's index has the learning data of every shape of a plan whose methods learn.
bool has_learning_data(const Plan& plan, const std::filesystem::path& folder);

/// Good where all was made and no shape has too few collisions that broke it.
ExitCode exit_code_of(const LearningResult& result);

/// "[ 12/300] 4 %, 9 broken, 3 unbroken, 1 min 20 s left; pot single-0012 bem".
std::string describe_learning(const RunProgress& progress);

/// "pot: 249 of 300 collisions broke it: 199 train, 50 test, 0 spare; 51 unbroken, 0 failed; ...".
std::string describe(const LearningShape& shape);

/// "cells", "complete", "stopped", "shortages" and, by shape, the number in each role and
/// "max_impulse".
nlohmann::ordered_json to_json(const LearningResult& result);

}  // namespace fracbench
