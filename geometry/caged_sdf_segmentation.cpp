#include "geometry/caged_sdf_segmentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/available_memory.h"
#include "core/error.h"
#include "geometry/segmentation/extended_minima.h"
#include "geometry/segmentation/flood_grid.h"
#include "geometry/segmentation/join_labels.h"
#include "geometry/segmentation/watershed.h"

namespace fracbench {
namespace {

constexpr double published_cage = 0.03;         // epsilon of section 5.2, m
constexpr std::int64_t minimum_up_to_128 = 50;  // from the authors' published script
constexpr std::int64_t minimum_above_128 = 500;

// The relief and its labels take 8 bytes, the result 4, the queue 2 where it is longest.
constexpr std::uint64_t bytes_per_voxel = 14;
constexpr std::uint64_t worth_asking = std::uint64_t{1} << 24;  // asking takes a while, too

void check(const VoxelGrid<float>& field, const SegmentationOptions& options) {
  const auto [nx, ny, nz] = field.size;
  if (nx <= 0 || ny <= 0 || nz <= 0) {
    throw InputError(fmt::format(
        "the field's size is {} x {} x {}; every side needs at least one voxel", nx, ny, nz));
  }
  const auto largest = static_cast<double>(max_flood_voxels);
  if ((nx + 3.0) * (ny + 3.0) * (nz + 3.0) >= largest) {
    throw InputError(fmt::format(
        "the field has {} x {} x {} voxels; segmentation takes fewer than 2^31 with a rim of one "
        "voxel: use a coarser grid",
        nx, ny, nz));
  }
  const std::size_t count = static_cast<std::size_t>(nx) * ny * nz;
  if (count > worth_asking && count * bytes_per_voxel > available_memory()) {
    throw InputError(fmt::format(
        "the field has {} x {} x {} voxels; segmentation takes {:.1f} GB of memory beside it, of "
        "which {:.1f} are available: use a coarser grid, or a machine with more memory",
        nx, ny, nz, static_cast<double>(count * bytes_per_voxel) / 1e9,
        static_cast<double>(available_memory()) / 1e9));
  }
  if (field.values.size() != count) {
    throw InputError(fmt::format("the field's size is {} x {} x {} = {} voxels, but it holds {}",
                                 nx, ny, nz, count, field.values.size()));
  }
  if (!(field.spacing > 0) || !std::isfinite(field.spacing)) {
    throw InputError(
        fmt::format("the field's spacing is {} m; it must be positive", field.spacing));
  }
  if (options.cage && !(*options.cage >= 0 && *options.cage <= 1)) {
    throw InputError(fmt::format("cage is {} m; it must be between 0 and 1", *options.cage));
  }
  if (!(options.h >= 0 && options.h <= 255)) {
    throw InputError(fmt::format("h is {}; it must be between 0 and 255", options.h));
  }
  if (options.minimum_voxels && *options.minimum_voxels < 0) {
    throw InputError(
        fmt::format("minimum_voxels is {}; it must not be negative", *options.minimum_voxels));
  }
}

/// Voxels per label; entry 0: those of the mask that have none.
std::vector<std::int64_t> voxels_by_label(const FloodGrid& grid, std::int32_t count) {
  std::vector<std::int64_t> voxels(count + 1, 0);
  for (const FloodGrid::Brick& brick : grid.storage) {
    for (const auto& [height, label] : brick.cells) {
      if (label != flood::wall) ++voxels[std::max(label, 0)];
    }
  }
  return voxels;
}

/// Turns everything with g < 0 into walls.
void apply_mask(const VoxelGrid<float>& field, float cage, FloodGrid& grid) {
  for (int k = 0; k < field.size[2]; ++k) {
    for (int j = 0; j < field.size[1]; ++j) {
      const float* from = &field.values[field.index(0, j, k)];
      const std::int32_t to = grid.row(j, k);
      for (int i = 0; i < field.size[0]; ++i) {
        if (from[i] + cage < 0) grid.label(to + FloodGrid::column(i)) = flood::wall;
      }
    }
  }
}

/// Numbers from 1 for the labels that `is_kept`, in order; 0 for the others.
template <typename IsKept>
std::vector<std::int32_t> compact_numbers(std::size_t count, const IsKept& is_kept) {
  std::vector<std::int32_t> number(count, 0);
  std::int32_t next = 0;
  for (std::size_t label = 1; label < count; ++label) {
    if (is_kept(static_cast<std::int32_t>(label))) number[label] = ++next;
  }
  return number;
}

void write_labels(const FloodGrid& grid, const std::vector<std::int32_t>& number,
                  VoxelGrid<std::int32_t>& labels) {
  for (int k = 0; k < labels.size[2]; ++k) {
    for (int j = 0; j < labels.size[1]; ++j) {
      const std::int32_t from = grid.row(j, k);
      std::int32_t* to = &labels.values[labels.index(0, j, k)];
      for (int i = 0; i < labels.size[0]; ++i) {
        const std::int32_t label = grid.label(from + FloodGrid::column(i));
        to[i] = label > 0 ? number[label] : label == flood::wall ? -1 : 0;
      }
    }
  }
}

}  // namespace

Segmentation caged_sdf_segmentation(const VoxelGrid<float>& field,
                                    const SegmentationOptions& options) {
  check(field, options);
  const int r = *std::max_element(field.size.begin(), field.size.end());
  Segmentation result;
  result.cage = options.cage.value_or(options.parity ? published_cage
                                                     : std::max(published_cage, field.spacing / 2));
  result.minimum_voxels =
      options.minimum_voxels.value_or(r <= 128 ? minimum_up_to_128 : minimum_above_128);

  const auto cage = static_cast<float>(result.cage);
  FloodGrid grid = make_flood_grid(field, cage, !options.parity, options.threads);
  const ExtendedMinima minima =
      label_extended_minima(grid, static_cast<float>(options.h), options.threads);
  flood_watershed(grid, minima);
  if (options.parity) apply_mask(field, cage, grid);

  const std::vector<std::int64_t> voxels = voxels_by_label(grid, minima.count);
  result.mask_voxels = std::accumulate(voxels.begin(), voxels.end(), std::int64_t{0});
  if (result.mask_voxels == 0) {
    throw InputError(
        fmt::format("the field is below -{:g} (the cage) everywhere, so nothing lies inside; a "
                    "GS-SDF is positive inside the body: is its sign reversed?",
                    result.cage));
  }
  result.dam_voxels = voxels[0];
  result.flooded_labels = static_cast<std::int32_t>(
      std::count_if(voxels.begin() + 1, voxels.end(), [](std::int64_t n) { return n > 0; }));

  std::vector<std::int32_t> number;
  if (options.parity) {
    number = compact_numbers(voxels.size(), [&](std::int32_t label) {
      return voxels[label] > 0 && voxels[label] >= result.minimum_voxels;
    });
    result.count = *std::max_element(number.begin(), number.end());
    result.dropped_labels = result.flooded_labels - result.count;
  } else {
    give_dams_to_labels(grid);
    const JoinedLabels joined = join_small_labels(grid, voxels, result.minimum_voxels);
    number = compact_numbers(voxels.size(),
                             [&](std::int32_t label) { return joined.target[label] == label; });
    for (std::size_t label = 1; label < number.size(); ++label) {
      number[label] = number[joined.target[label]];
    }
    result.dropped_labels = joined.joined;
    result.islands = joined.islands;
    result.count = result.flooded_labels - joined.joined;
  }
  result.labels = VoxelGrid<std::int32_t>(field.size, field.origin, field.spacing);
  write_labels(grid, number, result.labels);
  return result;
}

}  // namespace fracbench
