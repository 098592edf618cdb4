#include "geometry/segmentation/watershed.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "geometry/segmentation/flood_queue.h"

namespace fracbench {
namespace {

constexpr float highest_relief = 128.5f;      // at g = 0, imposed
constexpr std::uint32_t scout = 0x80000000u;  // marks entries that carry a height, but no label

class Flooding {
 public:
  Flooding(FloodGrid& grid, float lowest, std::size_t voxels)
      : grid_(grid), queue_(lowest, highest_relief, voxels) {}

  void start(const std::vector<std::int32_t>& minima) {
    for (const std::int32_t voxel : minima) reach_neighbours(voxel, look_around(voxel).open, 0);
  }

  void run() {
    FloodQueue::Entry entry;
    while (queue_.pop(entry)) {
      const auto voxel = static_cast<std::int32_t>(entry.item & ~scout);
      if (const FloodQueue::Entry* next = queue_.upcoming(4)) prefetch(*next);
      if ((entry.item & scout) != 0) {
        // Where a label has reached the voxel since, its own entry has the same height.
        if (grid_.label(voxel) == flood::reached) scout_neighbours(voxel, entry.value);
        continue;
      }
      const Surroundings around = look_around(voxel);
      grid_.label(voxel) = around.label;
      if (around.label == flood::dam) {
        scout_neighbours(voxel, entry.value);
      } else {
        reach_neighbours(voxel, around.open, entry.value);
      }
    }
  }

 private:
  struct Surroundings {
    std::int32_t label;  ///< the only one among the neighbours; a dam where there are several
    unsigned open;       ///< bit i: no label has touched the neighbour i
  };

  Surroundings look_around(std::int32_t voxel) const {
    const FloodGrid::Steps& steps = grid_.steps(voxel);
    std::int32_t highest = 0, lowest = std::numeric_limits<std::int32_t>::max();
    unsigned open = 0;
    for (int i = 0; i < 6; ++i) {
      const std::int32_t label = grid_.label(voxel + steps[i]);
      highest = std::max(highest, label);
      lowest = std::min(lowest, label > 0 ? label : lowest);
      open |= static_cast<unsigned>((label == flood::untouched) | (label == flood::reached)) << i;
    }
    return {highest == lowest ? highest : flood::dam, open};
  }

  static void impose(FloodGrid::Cell& cell, float level) {
    cell.height = std::max(cell.height + 1.0f, level);
  }

  void reach_neighbours(std::int32_t voxel, unsigned open, float level) {
    const FloodGrid::Steps& steps = grid_.steps(voxel);
    for (; open != 0; open &= open - 1) {
      const std::int32_t neighbour = voxel + steps[std::countr_zero(open)];
      FloodGrid::Cell& to = grid_.cell(neighbour);
      if (to.label == flood::untouched) impose(to, level);
      to.label = flood::queued;
      queue_.push({to.height, static_cast<std::uint32_t>(neighbour)});
    }
  }

  /// Keeps the imposed heights right behind a dam.
  void scout_neighbours(std::int32_t voxel, float level) {
    for (const std::int32_t step : grid_.steps(voxel)) {
      FloodGrid::Cell& to = grid_.cell(voxel + step);
      if (to.label != flood::untouched) continue;
      impose(to, level);
      to.label = flood::reached;
      queue_.push({to.height, static_cast<std::uint32_t>(voxel + step) | scout});
    }
  }

  void prefetch(const FloodQueue::Entry& entry) const {
    const auto voxel = static_cast<std::int32_t>(entry.item & ~scout);
    for (const std::int32_t step : grid_.steps(voxel))
      __builtin_prefetch(&grid_.cell(voxel + step));
  }

  FloodGrid& grid_;
  FloodQueue queue_;
};

}  // namespace

void flood_watershed(FloodGrid& grid, const ExtendedMinima& minima) {
  std::size_t voxels = 0;
  float lowest = highest_relief;
  for (const FloodGrid::Brick& brick : grid.storage) {
    for (const FloodGrid::Cell& cell : brick.cells) {
      if (cell.label != flood::untouched) continue;
      ++voxels;
      lowest = std::min(lowest, cell.height + 1.0f);
    }
  }
  Flooding flooding(grid, std::max(lowest, 0.0f), voxels);
  flooding.start(minima.voxels);
  flooding.run();
}

}  // namespace fracbench
