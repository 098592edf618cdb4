#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fracbench {

/// Why a results folder became the baseline; the last one of `accepted.json` in its folder.
struct Acceptance {
  std::string when;  ///< UTC, as 2026-01-31T12:00:00Z
  std::string who;
  std::string why;
  std::string suite;
  std::size_t cells = 0;
  bool operator==(const Acceptance&) const = default;
};

/// Makes a copy of the candidate the baseline, in one step: a copy is made beside the baseline and
/// synced, and takes its place by one renaming, so that there is always a whole baseline, the old
/// one or the new. The notes of earlier acceptances are kept. `note` names who and why; the rest is
/// filled in. Returns the note as written.
/// Throws InputError where the candidate has not a good record for each cell of its suite, where
/// `who` or `why` are empty, where the baseline's path holds anything but results, or where it
/// cannot be written; the old baseline is then untouched.
Acceptance accept_baseline(const std::filesystem::path& baseline,
                           const std::filesystem::path& candidate, Acceptance note);

/// Oldest first; empty where nothing was accepted. Throws InputError where the file is damaged.
std::vector<Acceptance> read_acceptances(const std::filesystem::path& folder);

}  // namespace fracbench
