#include "geometry/segmentation/extended_minima.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace fracbench {
namespace {

/// An integer that orders as the float does.
std::uint32_t ordered_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value + 0.0f);  // -0 and 0 are one value
  return bits >> 31 ? ~bits : bits | 0x80000000u;
}

/// The voxels that are not above any neighbour, and the first of their plateau as far as the
/// neighbours show it; lowest first, then in the order of the grid. Every regional minimum is in
/// it.
std::vector<std::int32_t> local_minima(const FloodGrid& grid) {
  std::vector<std::uint64_t> found;  // height and voxel in one number
  std::vector<std::uint8_t> is_minimum(grid.size[0] + 8);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      const std::int32_t first = grid.index(0, j, k);
      const float* h = &grid.height[first];
      for (int i = 0; i < grid.size[0]; ++i) {
        is_minimum[i] = (h[i] < h[i - 1]) & (h[i] < h[i - grid.row]) & (h[i] < h[i - grid.plane]) &
                        (h[i] <= h[i + 1]) & (h[i] <= h[i + grid.row]) &
                        (h[i] <= h[i + grid.plane]);
      }
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!is_minimum[i]) continue;
        found.push_back(std::uint64_t{ordered_bits(h[i])} << 32 | static_cast<unsigned>(first + i));
      }
    }
  }
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
  std::int32_t first_voxel = 0;  ///< in the order of the grid
};

/// Appends the voxels of the flood to `visited` and labels them `mark`; false where an earlier
/// flood is met.
bool flood_from(std::int32_t start, float h, std::int32_t mark, FloodGrid& grid,
                std::vector<std::int32_t>& visited) {
  const float level = grid.height[start] + h;
  const std::array<std::int32_t, 6> steps = grid.steps();
  std::size_t next = visited.size();
  visited.push_back(start);
  grid.label[start] = mark;
  while (next < visited.size()) {
    const std::int32_t voxel = visited[next++];
    for (const std::int32_t step : steps) {
      const std::int32_t to = voxel + step;
      if (grid.height[to] > level || grid.label[to] == mark) continue;
      if (grid.label[to] != flood::untouched) {
        if (grid.label[to] != flood::wall) return false;
        continue;
      }
      if (grid.height[to] + h < level) return false;  // runs out into a deeper basin
      grid.label[to] = mark;
      visited.push_back(to);
    }
  }
  return true;
}

/// Stable counting sort by one coordinate.
template <typename Coordinate>
void sort_by(std::vector<std::int32_t>& voxels, int range, const Coordinate& coordinate) {
  std::vector<std::size_t> start(range + 1, 0);
  for (const std::int32_t voxel : voxels) ++start[coordinate(voxel) + 1];
  for (int i = 0; i < range; ++i) start[i + 1] += start[i];
  std::vector<std::int32_t> sorted(voxels.size());
  for (const std::int32_t voxel : voxels) sorted[start[coordinate(voxel)]++] = voxel;
  voxels = std::move(sorted);
}

}  // namespace

ExtendedMinima label_extended_minima(FloodGrid& grid, float h) {
  std::vector<std::int32_t> visited;
  std::vector<Flood> minima;
  std::int32_t mark = 0;
  std::vector<std::int32_t> others;  // visited, but in no minimum
  for (const std::int32_t start : local_minima(grid)) {
    if (grid.label[start] != flood::untouched) continue;
    const std::size_t begin = visited.size();
    if (flood_from(start, h, ++mark, grid, visited)) {
      const auto first = visited.begin() + static_cast<std::ptrdiff_t>(begin);
      minima.push_back({begin, visited.size(), *std::min_element(first, visited.end())});
    } else {
      others.insert(others.end(), visited.begin() + static_cast<std::ptrdiff_t>(begin),
                    visited.end());
      visited.resize(begin);
    }
  }
  for (const std::int32_t voxel : others) grid.label[voxel] = flood::untouched;

  std::sort(minima.begin(), minima.end(),
            [](const Flood& a, const Flood& b) { return a.first_voxel < b.first_voxel; });
  ExtendedMinima result;
  for (const Flood& flood : minima) {
    ++result.count;
    for (std::size_t i = flood.begin; i < flood.end; ++i) grid.label[visited[i]] = result.count;
  }
  result.voxels = std::move(visited);
  sort_by(result.voxels, grid.size[1] + 2,
          [&](std::int32_t v) { return v % grid.plane / grid.row; });
  sort_by(result.voxels, grid.row, [&](std::int32_t v) { return v % grid.row; });
  sort_by(result.voxels, grid.size[2] + 2, [&](std::int32_t v) { return v / grid.plane; });
  return result;
}

}  // namespace fracbench
