#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/cell_summary.h"
#include "harness/stored_suite.h"

namespace fracbench {

/// All that reports need of a results folder: all but meshes and trajectories.
struct Results {
  StoredSuite suite;
  std::vector<CellSummary> cells;       ///< by shape, scenario, repeat and label
  std::vector<std::string> unreadable;  ///< messages on records that are damaged: not in `cells`
};

/// Throws InputError where it is no results folder.
Results read_results(const std::filesystem::path& folder);

/// Only the cells of read_results.
std::vector<CellSummary> read_summaries(const std::filesystem::path& folder);

}  // namespace fracbench
