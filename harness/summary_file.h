#pragma once

#include <filesystem>
#include <vector>

#include "harness/acceptance.h"
#include "harness/summaries.h"

namespace fracbench {

/// Whether a path stands for a summary file rather than for a results folder: by its ending, .json.
bool names_summary_file(const std::filesystem::path& path);

/// Writes what compare needs of results into one text file, a line for each cell, small enough for
/// a repository: no meshes, no trajectories, a few kB a cell. All numbers keep all their bits.
/// Appears whole or not at all. Throws InputError where it cannot be written.
void write_summary_file(const std::filesystem::path& file, const Results& results,
                        const std::vector<Acceptance>& accepted);

struct SummaryFile {
  Results results;
  std::vector<Acceptance> accepted;
};

/// Throws InputError for a file that is missing, damaged or of another version.
SummaryFile read_summary_file(const std::filesystem::path& file);

}  // namespace fracbench
