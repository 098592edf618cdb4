#include "geometry/label_volume/checked_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/available_memory.h"
#include "core/error.h"

namespace fracbench {

std::array<std::int32_t, 3> checked_size(const std::array<std::uint64_t, 3>& sizes,
                                         std::uint64_t bytes_per_voxel, std::string_view file) {
  constexpr std::uint64_t longest = std::numeric_limits<std::int32_t>::max();
  double bytes = static_cast<double>(bytes_per_voxel);
  for (const std::uint64_t side : sizes) {
    if (side < 1 || side > longest) {
      throw InputError(
          fmt::format("{}: the volume's size is {} x {} x {}; a side has 1 to {} voxels", file,
                      sizes[0], sizes[1], sizes[2], longest));
    }
    bytes *= static_cast<double>(side);
  }
  const auto available = static_cast<double>(std::min(available_memory(), std::uint64_t{1} << 56));
  if (bytes > available) {
    throw InputError(
        fmt::format("{}: the volume has {} x {} x {} voxels; reading it takes {:.1f} GB of memory, "
                    "of which {:.1f} "
                    "are available: use a coarser grid, or a machine with more memory",
                    file, sizes[0], sizes[1], sizes[2], bytes / 1e9, available / 1e9));
  }
  return {static_cast<std::int32_t>(sizes[0]), static_cast<std::int32_t>(sizes[1]),
          static_cast<std::int32_t>(sizes[2])};
}

double checked_spacing(const std::array<double, 3>& spacings, std::string_view field,
                       std::string_view file) {
  for (const double spacing : spacings) {
    if (!(spacing > 0) || !std::isfinite(spacing)) {
      throw InputError(
          fmt::format("{}: {} is {:g} along an axis; it must be positive", file, field, spacing));
    }
    if (std::abs(spacing - spacings[0]) > 1e-6 * spacings[0]) {
      throw InputError(
          fmt::format("{}: {} is {:g} x {:g} x {:g}; only volumes of cubic voxels are supported: "
                      "resample it",
                      file, field, spacings[0], spacings[1], spacings[2]));
    }
  }
  return spacings[0];
}

}  // namespace fracbench
