#pragma once

#include <filesystem>
#include <vector>

#include "harness/acceptance.h"

namespace fracbench {

/// Makes the candidate the baseline. Where the baseline's path ends in .json, its summary is
/// written there (summary_file.h). Else a copy of the folder becomes the baseline, in one step: a
/// copy is made beside the baseline and synced, and takes its place by one renaming, so that there
/// is always a whole baseline, the old one or the new. The notes of earlier acceptances are kept.
/// `note` names who and why; the rest is filled in. Returns the note as written. Throws InputError
/// where the candidate has not a good record for each cell of its suite, where `who` or `why` are
/// empty, where the baseline's path holds anything but results, or where it cannot be written; the
/// old baseline is then untouched.
Acceptance accept_baseline(const std::filesystem::path& baseline,
                           const std::filesystem::path& candidate, const Acceptance& note);

/// Of a folder or a summary file, oldest first; empty where nothing was accepted. Throws InputError
/// where they are damaged.
std::vector<Acceptance> read_acceptances(const std::filesystem::path& baseline);

}  // namespace fracbench
