#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "harness/data_tree.h"

namespace fracbench {

/// Which arrays, by path.
using ArrayFilter = std::function<bool(std::string_view)>;

/// The tree as the bytes of an HDF5 file. The same tree gives the same bytes. Large arrays are
/// compressed (shuffle and deflate), with `packed` only those for which that pays.
std::string to_hdf5(const DataTree& tree, const ArrayFilter& packed = {});

/// Reads an HDF5 file that holds a tree; with a filter only part of it. Nothing in the file is
/// believed: the sizes of arrays are checked against that of the file before memory is taken, and
/// links to elsewhere, foreign filters and foreign types are refused. Throws DataError.
DataTree read_hdf5(const std::filesystem::path& file, const ArrayFilter& filter = {});

}  // namespace fracbench
