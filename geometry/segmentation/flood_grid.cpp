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

/// False where a value of the row is not finite. `relief` is infinite where a wall is to be.
bool relief_of_row(const float* field, int count, float cage, bool inside_only, float* relief) {
  int bad = 0;
  for (int i = 0; i < count; ++i) {
    const float g = field[i] + cage;
    const float value = 255.0f - (std::abs(g) + 1.0f) / 2.0f * 255.0f;
    bad |= !(std::abs(field[i]) < infinite);
    relief[i] = (inside_only && g < 0) ? infinite : value;
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

FloodGrid::FloodGrid(std::array<std::int32_t, 3> size_) : size(size_) {
  for (int axis = 0; axis < 3; ++axis) bricks[axis] = (size[axis] + 3) / 2;
  storage.resize(static_cast<std::size_t>(bricks[0]) * bricks[1] * bricks[2]);
  const std::array<std::int32_t, 3> brick_step{8, 8 * bricks[0], 8 * bricks[0] * bricks[1]};
  for (int place_in_brick = 0; place_in_brick < 8; ++place_in_brick) {
    std::array<std::int32_t, 3> up{}, down{};
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t bit = 1 << axis;
      const bool is_upper = (place_in_brick & bit) != 0;
      up[axis] = is_upper ? brick_step[axis] - bit : bit;
      down[axis] = is_upper ? -bit : bit - brick_step[axis];
    }
    steps_[place_in_brick] = {down[2], down[0], down[1], up[1], up[0], up[2]};
  }
}

std::array<std::int32_t, 3> FloodGrid::place(std::int32_t voxel) const {
  const std::int32_t brick = voxel >> 3;
  return {2 * (brick % bricks[0]) + (voxel & 1) - 1,
          2 * (brick / bricks[0] % bricks[1]) + (voxel >> 1 & 1) - 1,
          2 * (brick / bricks[0] / bricks[1]) + (voxel >> 2 & 1) - 1};
}

FloodGrid make_flood_grid(const VoxelGrid<float>& field, float cage, bool inside_only,
                          int threads) {
  FloodGrid grid(field.size);
  const auto [nx, ny, nz] = field.size;
  std::atomic<bool> bad = false;
  // Layers and rows of bricks, so that two threads never write to one brick.
  parallel_for(grid.bricks[2], threads, [&, nx = nx, ny = ny, nz = nz](std::size_t layer) {
    std::vector<float> relief(nx);
    const int first = 2 * static_cast<int>(layer) - 1;
    for (int j = -1; j < ny; j += 2) {
      for (int k = std::max(first, 0); k < std::min(first + 2, nz); ++k) {
        for (int row = std::max(j, 0); row < std::min(j + 2, ny); ++row) {
          if (!relief_of_row(&field.values[field.index(0, row, k)], nx, cage, inside_only,
                             relief.data())) {
            bad = true;
          }
          const std::int32_t to = grid.row(row, k);
          for (int i = 0; i < nx; ++i) {
            grid.cell(to + FloodGrid::column(i)) = {
                relief[i], relief[i] == infinite ? flood::wall : flood::untouched};
          }
        }
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
      const std::int32_t from = grid.row(j, k);
      std::int32_t* to = &labels.values[labels.index(0, j, k)];
      for (int i = 0; i < field.size[0]; ++i) {
        const std::int32_t label = grid.label(from + FloodGrid::column(i));
        to[i] = label > 0 ? label : none;
      }
    }
  }
  return labels;
}

}  // namespace fracbench
