#include "geometry/signed_distance_grid.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/signed_distance/distance_brick.h"
#include "geometry/signed_distance/winding_scan.h"

namespace fracbench {
namespace {

/// Distances of two rows in two slices.
void fill_rows(const TriangleTree& tree, VoxelGrid<float>& grid, int j, int k) {
  DistanceBrick brick;
  DistanceBrick::Guess guess;
  for (int i = 0; i < grid.size[0]; i += 2) {
    brick.place(grid, i, j, k);
    const auto nearest = brick.nearest(tree, guess);
    for (int lane = 0; lane < DistanceBrick::size; ++lane) {
      grid.values[brick.samples()[lane]] =
          static_cast<float>(std::sqrt(nearest[lane].squared_distance));
    }
  }
}

}  // namespace

VoxelGrid<float> signed_distance_grid(const TriangleMesh& mesh, VoxelGrid<float> grid,
                                      int threads) {
  if (mesh.empty()) throw InputError("signed distance: the mesh is empty");
  const TriangleTree tree(mesh);
  const WindingScan scan(mesh, grid);
  const int pairs = (grid.size[2] + 1) / 2;
  parallel_for(pairs, threads, [&](std::size_t pair) {
    const int first_k = 2 * static_cast<int>(pair);
    for (int j = 0; j < grid.size[1]; j += 2) fill_rows(tree, grid, j, first_k);
    for (int k = first_k; k < std::min(first_k + 2, grid.size[2]); ++k) {
      const std::vector<std::int32_t> winding = scan.slice(k);
      for (int j = 0; j < grid.size[1]; ++j) {
        for (int i = 0; i < grid.size[0]; ++i) {
          if (winding[i + scan.row() * j] == 0) grid.at(i, j, k) *= -1;
        }
      }
    }
  });
  return grid;
}

}  // namespace fracbench
