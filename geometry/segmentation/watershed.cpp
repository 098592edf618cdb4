#include "geometry/segmentation/watershed.h"

#include <algorithm>

#include "geometry/segmentation/flood_queue.h"

namespace fracbench {
namespace {

constexpr float highest_relief = 128.5f;      // at g = 0, imposed
constexpr std::uint32_t scout = 0x80000000u;  // marks entries that carry a height, but no label

class Flooding {
 public:
  Flooding(FloodGrid& grid, std::size_t voxels) : grid_(grid), queue_(highest_relief, voxels) {}

  void start(const std::vector<std::int32_t>& minima) {
    for (const std::int32_t voxel : minima) reach_neighbours(voxel, 0);
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
      const std::int32_t label = label_beside(voxel);
      grid_.label(voxel) = label;
      if (label == flood::dam) {
        scout_neighbours(voxel, entry.value);
      } else {
        reach_neighbours(voxel, entry.value);
      }
    }
  }

 private:
  /// The only label among the neighbours; a dam where there are several.
  std::int32_t label_beside(std::int32_t voxel) const {
    std::int32_t label = 0;
    bool is_dam = false;
    for (const std::int32_t step : grid_.steps(voxel)) {
      const std::int32_t other = grid_.label(voxel + step);
      is_dam |= (other > 0) & (label > 0) & (other != label);
      label = std::max(label, other);
    }
    return is_dam ? flood::dam : label;
  }

  static void impose(FloodGrid::Cell& cell, float level) {
    cell.height = std::max(cell.height + 1.0f, level);
  }

  void reach_neighbours(std::int32_t voxel, float level) {
    for (const std::int32_t step : grid_.steps(voxel)) {
      FloodGrid::Cell& to = grid_.cell(voxel + step);
      if (to.label != flood::untouched && to.label != flood::reached) continue;
      if (to.label == flood::untouched) impose(to, level);
      to.label = flood::queued;
      queue_.push({to.height, static_cast<std::uint32_t>(voxel + step)});
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
  for (const FloodGrid::Brick& brick : grid.storage) {
    for (const FloodGrid::Cell& cell : brick.cells) voxels += cell.label == flood::untouched;
  }
  Flooding flooding(grid, voxels);
  flooding.start(minima.voxels);
  flooding.run();
}

}  // namespace fracbench
