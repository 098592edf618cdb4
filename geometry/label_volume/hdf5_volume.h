#pragma once

#include <cstdint>
#include <filesystem>

#include "core/voxel_grid.h"

namespace fracbench {

/// Whether a file carries the signature of HDF5.
bool is_hdf5(const std::filesystem::path& file);

/// See geometry/read_label_volume.h.
VoxelGrid<std::int32_t> read_hdf5_volume(const std::filesystem::path& file);

}  // namespace fracbench
