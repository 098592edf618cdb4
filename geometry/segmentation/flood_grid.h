#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/voxel_grid.h"

namespace fracbench {

/// Values of FloodGrid::label that are not labels (those are 1, 2, ...).
namespace flood {
inline constexpr std::int32_t untouched = 0;
inline constexpr std::int32_t queued = -1;   ///< waits for its turn
inline constexpr std::int32_t reached = -2;  ///< its height is final, but no label has touched it
inline constexpr std::int32_t dam = -3;      ///< between two labels
inline constexpr std::int32_t wall = -4;     ///< never flooded: the grid's rim, or outside the mask
}  // namespace flood

/// The volume in which segmentation works: a relief with a wall one voxel thick round it, so that
/// every voxel that can be flooded has six neighbours.
struct FloodGrid {
  std::array<std::int32_t, 3> size{0, 0, 0};  ///< of the volume without the rim
  std::int32_t row = 0;                       ///< steps from a voxel to the next one in y
  std::int32_t plane = 0;                     ///< ... in z
  std::vector<float> height;                  ///< infinite at walls
  std::vector<std::int32_t> label;

  std::int32_t index(int i, int j, int k) const { return i + 1 + row * (j + 1) + plane * (k + 1); }
  std::array<std::int32_t, 3> place(std::int32_t voxel) const {
    return {voxel % row - 1, voxel % plane / row - 1, voxel / plane - 1};
  }
  /// In the order in which a voxel touches its neighbours: z - 1, x - 1, y - 1, y + 1, x + 1, z
  /// + 1.
  std::array<std::int32_t, 6> steps() const { return {-plane, -1, -row, row, 1, plane}; }
};

/// The largest number of voxels in a grid to be segmented, rim included.
inline constexpr std::int64_t max_flood_voxels = std::int64_t{1} << 31;

/// The relief 255 - (|g| + 1) / 2 * 255 with g = field + cage, in single precision, every operation
/// rounded; untouched everywhere. With `inside_only`, voxels with g < 0 are walls.
/// The grid must have been checked (see caged_sdf_segmentation.h). Throws InputError at the first
/// voxel that is NaN or infinite.
FloodGrid make_flood_grid(const VoxelGrid<float>& field, float cage, bool inside_only,
                          int threads = 1);

/// The labels without the rim; voxels without one become `none`.
VoxelGrid<std::int32_t> labels_of(const FloodGrid& grid, const VoxelGrid<float>& field,
                                  std::int32_t none = 0);

}  // namespace fracbench
