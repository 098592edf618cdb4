#pragma once

#include <algorithm>
#include <array>

#include "core/voxel_grid.h"
#include "geometry/triangle_tree.h"

namespace fracbench {

/// 2 x 2 x 2 samples of a grid, whose distances are found together. A brick at the far edges of the
/// grid repeats its last samples.
class DistanceBrick {
 public:
  static constexpr int size = 8;

  /// The brick whose first sample is (i, j, k).
  void place(const VoxelGrid<float>& grid, int i, int j, int k) {
    for (int lane = 0; lane < size; ++lane) {
      const int x = std::min(i + (lane & 1), grid.size[0] - 1);
      const int y = std::min(j + (lane >> 1 & 1), grid.size[1] - 1);
      const int z = std::min(k + (lane >> 2), grid.size[2] - 1);
      queries_[lane] = grid.position(x, y, z);
      samples_[lane] = grid.index(x, y, z);
    }
  }
  /// Where the samples of the brick are in the grid's values.
  const std::array<std::size_t, size>& samples() const { return samples_; }

  /// Triangles that are likely to be near the next brick along x; one for each tree.
  struct Guess {
    std::array<std::int32_t, size> start;
    Guess() { start.fill(-1); }
  };
  std::array<TriangleTree::Nearest, size> nearest(const TriangleTree& tree, Guess& guess) const {
    const auto result =
        tree.nearest(TriangleTree::Group<size>{.queries = queries_, .start = guess.start});
    for (int lane = 0; lane < size; ++lane) guess.start[lane] = result[lane | 1].triangle;
    return result;
  }

 private:
  std::array<Vec3, size> queries_;
  std::array<std::size_t, size> samples_;
};

}  // namespace fracbench
