#pragma once

#include <cstdint>
#include <filesystem>

#include "core/voxel_grid.h"

namespace fracbench {

/// See geometry/read_label_volume.h.
VoxelGrid<std::int32_t> read_nrrd_volume(const std::filesystem::path& file);

}  // namespace fracbench
