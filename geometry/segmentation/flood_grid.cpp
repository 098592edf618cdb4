#include "geometry/segmentation/flood_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"

namespace fracbench {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// False where a value of the row is not finite.
bool fill_row(const float* field, int count, float cage, bool inside_only, float* height,
              std::int32_t* label) {
  int bad = 0;
  for (int i = 0; i < count; ++i) {
    const float g = field[i] + cage;
    const float relief = 255.0f - (std::abs(g) + 1.0f) / 2.0f * 255.0f;
    const bool is_wall = inside_only & (g < 0);
    bad |= !(std::abs(field[i]) < infinite);
    height[i] = is_wall ? infinite : relief;
    label[i] = is_wall ? flood::wall : flood::untouched;
  }
  return bad == 0;
}

[[noreturn]] void report_bad_value(const VoxelGrid<float>& field) {
  for (int k = 0; k < field.size[2]; ++k) {
    for (int j = 0; j < field.size[1]; ++j) {
      for (int i = 0; i < field.size[0]; ++i) {
        const float value = field.at(i, j, k);
        if (std::isfinite(value)) continue;
        const Vec3 x = field.position(i, j, k);
        throw InputError(fmt::format(
            "the field holds {} at voxel ({}, {}, {}), position ({:g}, {:g}, {:g}); a GS-SDF is "
            "finite everywhere: mend the program that made it, or replace such values by -1",
            std::isnan(value) ? "NaN" : "an infinite value", i, j, k, x.x(), x.y(), x.z()));
      }
    }
  }
  throw std::logic_error("no bad value in the field");
}

}  // namespace

FloodGrid make_flood_grid(const VoxelGrid<float>& field, float cage, bool inside_only,
                          int threads) {
  FloodGrid grid;
  grid.size = field.size;
  const auto [nx, ny, nz] = field.size;
  grid.row = nx + 2;
  grid.plane = grid.row * (ny + 2);
  const std::size_t count = static_cast<std::size_t>(grid.plane) * (nz + 2);
  grid.height.resize(count, infinite);
  grid.label.resize(count, flood::wall);

  std::atomic<bool> bad = false;
  parallel_for(nz, threads, [&](std::size_t k) {
    for (int j = 0; j < ny; ++j) {
      const std::int32_t to = grid.index(0, j, static_cast<int>(k));
      if (!fill_row(&field.values[field.index(0, j, static_cast<int>(k))], nx, cage, inside_only,
                    &grid.height[to], &grid.label[to])) {
        bad = true;
      }
    }
  });
  if (bad) report_bad_value(field);
  return grid;
}

VoxelGrid<std::int32_t> labels_of(const FloodGrid& grid, const VoxelGrid<float>& field,
                                  std::int32_t none) {
  VoxelGrid<std::int32_t> labels(field.size, field.origin, field.spacing);
  for (int k = 0; k < field.size[2]; ++k) {
    for (int j = 0; j < field.size[1]; ++j) {
      const std::int32_t* from = &grid.label[grid.index(0, j, k)];
      std::int32_t* to = &labels.values[labels.index(0, j, k)];
      for (int i = 0; i < field.size[0]; ++i) to[i] = from[i] > 0 ? from[i] : none;
    }
  }
  return labels;
}

}  // namespace fracbench
