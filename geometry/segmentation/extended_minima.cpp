#include "geometry/segmentation/extended_minima.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <span>
#include <utility>

#include "core/parallel.h"

namespace fracbench {
namespace {

/// An integer that orders as the float does.
std::uint32_t ordered_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value + 0.0f);  // -0 and 0 are one value
  return bits >> 31 ? ~bits : bits | 0x80000000u;
}

/// Three planes of the relief in plain rows, with the rim, for comparing neighbours in bulk.
class PlaneWindow {
 public:
  PlaneWindow(const FloodGrid& grid, int first)
      : grid_(grid),
        width_(grid.size[0] + 2),
        planes_{load(first - 1), load(first), load(first + 1)} {}

  void advance(int middle) {
    planes_[0].swap(planes_[1]);
    planes_[1].swap(planes_[2]);
    planes_[2] = load(middle + 1);
  }
  /// The row j of the plane below the middle one, of itself (1) or above it (2), from i = 0 on.
  const float* row(int plane, int j) const { return &planes_[plane][width_ * (j + 1) + 1]; }

 private:
  std::vector<float> load(int k) const {
    std::vector<float> plane(static_cast<std::size_t>(width_) * (grid_.size[1] + 2));
    for (int j = -1; j <= grid_.size[1]; ++j) {
      const std::int32_t from = grid_.row(j, k);
      float* to = &plane[static_cast<std::size_t>(width_) * (j + 1)];
      for (int i = -1; i <= grid_.size[0]; ++i) {
        to[i + 1] = grid_.height(from + FloodGrid::column(i));
      }
    }
    return plane;
  }

  const FloodGrid& grid_;
  std::size_t width_;
  std::array<std::vector<float>, 3> planes_;
};

/// The voxels of the planes [first, last) that are not above any neighbour, and the first of their
/// plateau as far as the neighbours show it. Every regional minimum has one. Height and voxel are
/// packed into one number.
std::vector<std::uint64_t> local_minima(const FloodGrid& grid, int first, int last) {
  std::vector<std::uint64_t> found;
  std::vector<std::uint8_t> is_minimum(grid.size[0]);
  PlaneWindow window(grid, first);
  for (int k = first; k < last; ++k) {
    if (k > first) window.advance(k);
    for (int j = 0; j < grid.size[1]; ++j) {
      const float* h = window.row(1, j);
      const float *south = window.row(1, j - 1), *north = window.row(1, j + 1);
      const float *below = window.row(0, j), *above = window.row(2, j);
      for (int i = 0; i < grid.size[0]; ++i) {
        is_minimum[i] = (h[i] < h[i - 1]) & (h[i] < south[i]) & (h[i] < below[i]) &
                        (h[i] <= h[i + 1]) & (h[i] <= north[i]) & (h[i] <= above[i]);
      }
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!is_minimum[i]) continue;
        found.push_back(std::uint64_t{ordered_bits(h[i])} << 32 |
                        static_cast<unsigned>(grid.index(i, j, k)));
      }
    }
  }
  return found;
}

/// All local minima, lowest first.
std::vector<std::int32_t> local_minima(const FloodGrid& grid, int threads) {
  constexpr int planes = 16;  // that one thread looks through at a time
  const int chunks = (grid.size[2] + planes - 1) / planes;
  std::vector<std::vector<std::uint64_t>> parts(chunks);
  parallel_for(chunks, threads, [&](std::size_t chunk) {
    const int first = planes * static_cast<int>(chunk);
    parts[chunk] = local_minima(grid, first, std::min(first + planes, grid.size[2]));
  });
  std::vector<std::uint64_t> found;
  for (const auto& part : parts) found.insert(found.end(), part.begin(), part.end());
  std::sort(found.begin(), found.end());
  std::vector<std::int32_t> voxels(found.size());
  std::transform(found.begin(), found.end(), voxels.begin(),
                 [](std::uint64_t key) { return static_cast<std::int32_t>(key & 0xffffffffu); });
  return voxels;
}

/// One flood from a local minimum: its voxels are visited[begin, end).
struct Flood {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::array<std::int32_t, 3> first_place{};  ///< z, y and x of the first voxel met by z, y, x
};

/// Appends the voxels of the flood to `visited` and labels them `mark`; false where an earlier
/// flood is met.
bool flood_from(std::int32_t start, float h, std::int32_t mark, FloodGrid& grid,
                std::vector<std::int32_t>& visited) {
  const float level = grid.height(start) + h;
  std::size_t next = visited.size();
  visited.push_back(start);
  grid.label(start) = mark;
  while (next < visited.size()) {
    const std::int32_t voxel = visited[next++];
    for (const std::int32_t step : grid.steps(voxel)) {
      FloodGrid::Cell& to = grid.cell(voxel + step);
      if (to.height > level || to.label == mark) continue;
      if (to.label != flood::untouched) return false;
      if (to.height + h < level) return false;  // runs out into a deeper basin
      to.label = mark;
      visited.push_back(voxel + step);
    }
  }
  return true;
}

std::array<std::int32_t, 3> first_place(const FloodGrid& grid,
                                        std::span<const std::int32_t> voxels) {
  std::array<std::int32_t, 3> first{std::numeric_limits<std::int32_t>::max(), 0, 0};
  for (const std::int32_t voxel : voxels) {
    const auto [i, j, k] = grid.place(voxel);
    first = std::min(first, {k, j, i});
  }
  return first;
}

/// By z, then x, then y.
std::vector<std::int32_t> in_seed_order(const FloodGrid& grid,
                                        std::span<const std::int32_t> voxels) {
  std::vector<std::pair<std::array<std::int32_t, 3>, std::int32_t>> keyed;
  keyed.reserve(voxels.size());
  for (const std::int32_t voxel : voxels) {
    const auto [i, j, k] = grid.place(voxel);
    keyed.push_back({{k, i, j}, voxel});
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::int32_t> sorted;
  sorted.reserve(voxels.size());
  for (const auto& [key, voxel] : keyed) sorted.push_back(voxel);
  return sorted;
}

}  // namespace

ExtendedMinima label_extended_minima(FloodGrid& grid, float h, int threads) {
  std::vector<std::int32_t> visited;
  std::vector<std::int32_t> others;  // visited, but in no minimum
  std::vector<Flood> minima;
  std::int32_t mark = 0;
  for (const std::int32_t start : local_minima(grid, threads)) {
    if (grid.label(start) != flood::untouched) continue;
    const std::size_t begin = visited.size();
    const bool is_minimum = flood_from(start, h, ++mark, grid, visited);
    const std::span<const std::int32_t> flooded(
        visited.begin() + static_cast<std::ptrdiff_t>(begin), visited.end());
    if (is_minimum) {
      minima.push_back({begin, visited.size(), first_place(grid, flooded)});
    } else {
      others.insert(others.end(), flooded.begin(), flooded.end());
      visited.resize(begin);
    }
  }
  for (const std::int32_t voxel : others) grid.label(voxel) = flood::untouched;

  std::sort(minima.begin(), minima.end(),
            [](const Flood& a, const Flood& b) { return a.first_place < b.first_place; });
  ExtendedMinima result;
  for (const Flood& flood : minima) {
    ++result.count;
    for (std::size_t i = flood.begin; i < flood.end; ++i) grid.label(visited[i]) = result.count;
  }
  result.voxels = in_seed_order(grid, visited);
  return result;
}

}  // namespace fracbench
