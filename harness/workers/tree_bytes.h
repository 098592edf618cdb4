#pragma once

#include <string>
#include <string_view>

#include "harness/data_tree.h"

namespace fracbench {

/// A tree as bytes for another process on this machine: plain and fast, for no file.
std::string to_bytes(const DataTree& tree);

/// The other way round. Takes no more memory than the bytes account for. Throws DataError where
/// they are cut short or contradict themselves.
DataTree tree_from_bytes(std::string_view bytes);

}  // namespace fracbench
