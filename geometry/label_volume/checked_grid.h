#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace fracbench {

/// The sizes of a volume that is about to be read, as grid sizes. Throws InputError, naming `file`,
/// where a side is below 1 or beyond 2^31 - 1, or the volume, at `bytes_per_voxel` while it is
/// read, does not fit into the memory that is available.
std::array<std::int32_t, 3> checked_size(const std::array<std::uint64_t, 3>& sizes,
                                         std::uint64_t bytes_per_voxel, std::string_view file);

/// The distance between neighbouring voxels, from that along x, y and z. Throws InputError, naming
/// `file` and `field`, where one is not positive and finite, or they differ by more than a
/// millionth: voxels are cubes.
double checked_spacing(const std::array<double, 3>& spacings, std::string_view field,
                       std::string_view file);

}  // namespace fracbench
