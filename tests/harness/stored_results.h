#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>

#include "harness/data_tree.h"

namespace fracbench {

/// What the records of a results folder hold apart from times: names to bytes. Throws DataError for
/// one that is not whole. Empty where there are none yet.
std::map<std::string, DataTree::Array> stored_results(const std::filesystem::path& folder);

/// Digests of the results of a folder's records, by their keys.
std::map<std::string, std::string> digests(const std::filesystem::path& folder);

/// Waits until a results folder has that many records, or the child that makes them has ended.
void wait_for_records(const std::filesystem::path& folder, std::size_t count, ::pid_t child);

}  // namespace fracbench
