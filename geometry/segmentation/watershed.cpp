#include "geometry/segmentation/watershed.h"

#include <algorithm>

#include "geometry/segmentation/flood_queue.h"

namespace fracbench {
namespace {

constexpr float highest_relief = 128.5f;      // at g = 0, imposed
constexpr std::uint32_t scout = 0x80000000u;  // marks entries that carry a height, but no label

class Flooding {
 public:
  Flooding(FloodGrid& grid, std::size_t voxels)
      : grid_(grid), steps_(grid.steps()), queue_(highest_relief, voxels) {}

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
        if (grid_.label[voxel] == flood::reached) scout_neighbours(voxel, entry.value);
        continue;
      }
      const std::int32_t label = label_beside(voxel);
      grid_.label[voxel] = label;
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
    for (const std::int32_t step : steps_) {
      const std::int32_t other = grid_.label[voxel + step];
      is_dam |= (other > 0) & (label > 0) & (other != label);
      label = std::max(label, other);
    }
    return is_dam ? flood::dam : label;
  }

  void impose(std::int32_t voxel, float level) {
    grid_.height[voxel] = std::max(grid_.height[voxel] + 1.0f, level);
  }

  void reach_neighbours(std::int32_t voxel, float level) {
    for (const std::int32_t step : steps_) {
      const std::int32_t to = voxel + step;
      const std::int32_t state = grid_.label[to];
      if (state != flood::untouched && state != flood::reached) continue;
      if (state == flood::untouched) impose(to, level);
      grid_.label[to] = flood::queued;
      queue_.push({grid_.height[to], static_cast<std::uint32_t>(to)});
    }
  }

  /// Keeps the imposed heights right behind a dam.
  void scout_neighbours(std::int32_t voxel, float level) {
    for (const std::int32_t step : steps_) {
      const std::int32_t to = voxel + step;
      if (grid_.label[to] != flood::untouched) continue;
      impose(to, level);
      grid_.label[to] = flood::reached;
      queue_.push({grid_.height[to], static_cast<std::uint32_t>(to) | scout});
    }
  }

  void prefetch(const FloodQueue::Entry& entry) const {
    const auto voxel = static_cast<std::int32_t>(entry.item & ~scout);
    for (const std::int32_t step : {-grid_.plane, -grid_.row, 0, grid_.row, grid_.plane}) {
      __builtin_prefetch(&grid_.label[voxel + step]);
      __builtin_prefetch(&grid_.height[voxel + step]);
    }
  }

  FloodGrid& grid_;
  std::array<std::int32_t, 6> steps_;
  FloodQueue queue_;
};

}  // namespace

void flood_watershed(FloodGrid& grid, const ExtendedMinima& minima) {
  const auto voxels =
      static_cast<std::size_t>(std::count(grid.label.begin(), grid.label.end(), flood::untouched));
  Flooding flooding(grid, voxels);
  flooding.start(minima.voxels);
  flooding.run();
}

}  // namespace fracbench
