#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/cell_summary.h"
#include "harness/stored_suite.h"
#include "neural/representation_study.h"

namespace fracbench {

/// All that reports need of a results folder: all but meshes and trajectories.
struct Results {
  StoredSuite suite;
  std::optional<neural::RepresentationStudy> study = {};
  std::vector<CellSummary> cells;       ///< by shape, scenario, repeat and label
  std::vector<std::string> unreadable;  ///< messages on what is damaged: not here
};

/// Throws InputError where it is no results folder.
Results read_results(const std::filesystem::path& folder);

/// Only the cells of read_results.
std::vector<CellSummary> read_summaries(const std::filesystem::path& folder);

}  // namespace fracbench
