#include "geometry/gs_sdf.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/fragment_labels.h"
#include "geometry/signed_distance/distance_brick.h"
#include "geometry/signed_distance/winding_scan.h"

namespace fracbench {
namespace {

/// Fills rows of bricks whose samples say already where they are: above 0 inside, below outside.
class BrickRow {
 public:
  BrickRow(const TriangleTree& fragments, const TriangleTree& original, VoxelGrid<float>& grid)
      : fragments_(fragments), original_(original), grid_(grid) {}

  void fill(int j, int k) const {
    DistanceBrick brick;
    DistanceBrick::Guess near_fragment, near_original;
    for (int i = 0; i < grid_.size[0]; i += 2) {
      brick.place(grid_, i, j, k);
      std::array<bool, DistanceBrick::size> inside;
      for (int lane = 0; lane < DistanceBrick::size; ++lane) {
        inside[lane] = grid_.values[brick.samples()[lane]] > 0;
      }
      const auto count = std::ranges::count(inside, true);
      if (count > 0) assign(brick, brick.nearest(fragments_, near_fragment), inside, true);
      if (count < DistanceBrick::size) {
        assign(brick, brick.nearest(original_, near_original), inside, false);
      }
    }
  }

 private:
  void assign(const DistanceBrick& brick,
              const std::array<TriangleTree::Nearest, DistanceBrick::size>& nearest,
              const std::array<bool, DistanceBrick::size>& inside, bool side) const {
    for (int lane = 0; lane < DistanceBrick::size; ++lane) {
      if (inside[lane] != side) continue;
      const auto distance = static_cast<float>(std::sqrt(nearest[lane].squared_distance));
      grid_.values[brick.samples()[lane]] = side ? distance : -distance;
    }
  }

  const TriangleTree& fragments_;
  const TriangleTree& original_;
  VoxelGrid<float>& grid_;
};

}  // namespace

VoxelGrid<float> gs_sdf(const TriangleMesh& original, const Fragments& fragments,
                        VoxelGrid<float> grid, const GsSdfOptions& options) {
  if (original.empty()) throw InputError("GS-SDF: the original mesh is empty");
  const FragmentSurfaces surfaces = fragment_surfaces(fragments);
  if (surfaces.mesh.empty()) throw InputError("GS-SDF: there are no fragments");

  const TriangleTree fragment_tree(surfaces.mesh);
  const TriangleTree original_tree(original);
  const WindingScan scan(surfaces.mesh, grid);
  const BrickRow row(fragment_tree, original_tree, grid);
  const int pairs = (grid.size[2] + 1) / 2;
  parallel_for(pairs, options.threads, [&](std::size_t pair) {
    const int first_k = 2 * static_cast<int>(pair);
    for (int k = first_k; k < std::min(first_k + 2, grid.size[2]); ++k) {
      const std::vector<std::int32_t> winding = scan.slice(k);
      for (int j = 0; j < grid.size[1]; ++j) {
        for (int i = 0; i < grid.size[0]; ++i) {
          grid.at(i, j, k) = winding[i + scan.row() * j] != 0 ? 1.0f : -1.0f;
        }
      }
    }
    for (int j = 0; j < grid.size[1]; j += 2) row.fill(j, first_k);
  });
  if (options.truncation > 0) {
    const auto limit = static_cast<float>(options.truncation);
    for (float& value : grid.values) value = std::clamp(value, -limit, limit);
  }
  return grid;
}

}  // namespace fracbench
