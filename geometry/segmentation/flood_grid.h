#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
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
/// every voxel that can be flooded has six neighbours. A flood jumps about in the volume and asks
/// for the neighbours of each voxel; to touch little memory for that, 2 x 2 x 2 voxels lie together
/// in one cache line.
struct FloodGrid {
  struct Cell {
    float height = std::numeric_limits<float>::infinity();  ///< so it is at walls
    std::int32_t label = flood::wall;
  };
  struct alignas(64) Brick {
    std::array<Cell, 8> cells;
  };

  std::array<std::int32_t, 3> size{0, 0, 0};    ///< of the volume without the rim
  std::array<std::int32_t, 3> bricks{0, 0, 0};  ///< along x, y and z, with the rim
  std::vector<Brick> storage;

  FloodGrid() = default;
  explicit FloodGrid(std::array<std::int32_t, 3> size_);

  /// The number of a voxel: that of its row plus that of its column.
  std::int32_t row(int j, int k) const {
    const std::int32_t y = j + 1, z = k + 1;
    return 8 * bricks[0] * ((y >> 1) + bricks[1] * (z >> 1)) + 2 * (y & 1) + 4 * (z & 1);
  }
  static std::int32_t column(int i) {
    const std::int32_t x = i + 1;
    return 4 * x - 3 * (x & 1);
  }
  std::int32_t index(int i, int j, int k) const { return row(j, k) + column(i); }
  std::array<std::int32_t, 3> place(std::int32_t voxel) const;

  Cell& cell(std::int32_t voxel) { return storage[voxel >> 3].cells[voxel & 7]; }
  const Cell& cell(std::int32_t voxel) const { return storage[voxel >> 3].cells[voxel & 7]; }
  float& height(std::int32_t voxel) { return cell(voxel).height; }
  float height(std::int32_t voxel) const { return cell(voxel).height; }
  std::int32_t& label(std::int32_t voxel) { return cell(voxel).label; }
  std::int32_t label(std::int32_t voxel) const { return cell(voxel).label; }

  /// What leads from a voxel to its neighbours, in the order in which it touches them: z - 1, x -
  /// 1, y - 1, y + 1, x + 1, z + 1.
  using Steps = std::array<std::int32_t, 6>;
  const Steps& steps(std::int32_t voxel) const { return steps_[voxel & 7]; }

 private:
  std::array<Steps, 8> steps_{};  ///< by the place in the brick
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
