#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "harness/data_tree.h"

namespace fracbench {

/// What the records of a results folder hold apart from times: names to bytes. Throws DataError for
/// one that is not whole. Empty where there are none yet.
std::map<std::string, DataTree::Array> stored_results(const std::filesystem::path& folder);

}  // namespace fracbench
