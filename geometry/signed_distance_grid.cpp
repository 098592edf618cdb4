#include "geometry/signed_distance_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/line_crossing.h"
#include "geometry/triangle_tree.h"

namespace fracbench {
namespace {

/// The samples of one axis, in ascending order, exactly as VoxelGrid::position rounds them.
std::vector<double> axis_coordinates(const VoxelGrid<float>& grid, int axis) {
  std::vector<double> result;
  for (int i = 0; i < grid.size[axis]; ++i) {
    result.push_back(grid.position(axis == 0 ? i : 0, axis == 1 ? i : 0, axis == 2 ? i : 0)[axis]);
  }
  return result;
}

/// Indices of the coordinates in [low, high], as a half-open range.
std::pair<int, int> range_within(const std::vector<double>& coordinates, double low, double high) {
  const auto begin = std::lower_bound(coordinates.begin(), coordinates.end(), low);
  const auto end = std::upper_bound(begin, coordinates.end(), high);
  return {static_cast<int>(begin - coordinates.begin()),
          static_cast<int>(end - coordinates.begin())};
}

/// Which samples are inside, by counting the faces that each line of samples along x crosses.
class InsideScan {
 public:
  InsideScan(const TriangleMesh& mesh, const VoxelGrid<float>& grid)
      : mesh_(mesh),
        x_(axis_coordinates(grid, 0)),
        y_(axis_coordinates(grid, 1)),
        z_(axis_coordinates(grid, 2)),
        faces_of_slice_(grid.size[2]) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto [low, high] =
          std::minmax({mesh.corner(f, 0).z(), mesh.corner(f, 1).z(), mesh.corner(f, 2).z()});
      const auto [begin, end] = range_within(z_, low, high);
      for (int k = begin; k < end; ++k) faces_of_slice_[k].push_back(static_cast<std::int32_t>(f));
    }
  }

  /// For each sample of slice k, x fastest: not 0 where it is inside.
  std::vector<std::int32_t> slice(int k) const {
    // Each crossing changes the winding number of the samples beyond it.
    const std::size_t stride = x_.size() + 1;
    std::vector<std::int32_t> winding(stride * y_.size(), 0);
    for (const std::int32_t f : faces_of_slice_[k]) {
      const Vec3 &a = mesh_.corner(f, 0), &b = mesh_.corner(f, 1), &c = mesh_.corner(f, 2);
      const auto [low, high] = std::minmax({a.y(), b.y(), c.y()});
      const auto [begin, end] = range_within(y_, low, high);
      for (int j = begin; j < end; ++j) {
        const int crossing = line_crossing(a, b, c, y_[j], z_[k]);
        if (crossing != 0) winding[stride * j + first_beyond(a, b, c, crossing, j, k)] -= crossing;
      }
    }
    for (std::size_t j = 0; j < y_.size(); ++j) {
      const auto line = winding.begin() + static_cast<std::ptrdiff_t>(stride * j);
      std::partial_sum(line, line + static_cast<std::ptrdiff_t>(stride), line);
    }
    return winding;
  }

 private:
  /// The first sample of the line that is beyond the crossing.
  std::size_t first_beyond(const Vec3& a, const Vec3& b, const Vec3& c, int crossing, int j,
                           int k) const {
    const auto first = std::partition_point(x_.begin(), x_.end(), [&](double x) {
      return !is_beyond(a, b, c, crossing, Vec3(x, y_[j], z_[k]));
    });
    return static_cast<std::size_t>(first - x_.begin());
  }

  const TriangleMesh& mesh_;
  std::vector<double> x_, y_, z_;
  std::vector<std::vector<std::int32_t>> faces_of_slice_;
};

/// Distances of two rows in two slices, a brick of 2 x 2 x 2 samples at a time. Bricks at the far
/// edges of the grid repeat its last samples.
class DistanceScan {
 public:
  DistanceScan(const TriangleTree& tree, VoxelGrid<float>& grid) : tree_(tree), grid_(grid) {}

  void fill(int first_j, int first_k) const {
    TriangleTree::Group<8> brick;
    brick.start.fill(-1);
    for (int first_i = 0; first_i < grid_.size[0]; first_i += 2) {
      std::array<std::size_t, 8> place;
      for (int lane = 0; lane < 8; ++lane) {
        const int i = std::min(first_i + (lane & 1), grid_.size[0] - 1);
        const int j = std::min(first_j + (lane >> 1 & 1), grid_.size[1] - 1);
        const int k = std::min(first_k + (lane >> 2), grid_.size[2] - 1);
        brick.queries[lane] = grid_.position(i, j, k);
        place[lane] = grid_.index(i, j, k);
      }
      const auto nearest = tree_.nearest(brick);
      for (int lane = 0; lane < 8; ++lane) {
        grid_.values[place[lane]] = static_cast<float>(std::sqrt(nearest[lane].squared_distance));
        brick.start[lane] = nearest[lane | 1].triangle;
      }
    }
  }

 private:
  const TriangleTree& tree_;
  VoxelGrid<float>& grid_;
};

}  // namespace

VoxelGrid<float> signed_distance_grid(const TriangleMesh& mesh, VoxelGrid<float> grid,
                                      int threads) {
  if (mesh.empty()) throw InputError("signed distance: the mesh is empty");
  const TriangleTree tree(mesh);
  const InsideScan inside(mesh, grid);
  const DistanceScan distances(tree, grid);
  const int pairs = (grid.size[2] + 1) / 2;
  parallel_for(pairs, threads, [&](std::size_t pair) {
    const int first_k = 2 * static_cast<int>(pair);
    for (int j = 0; j < grid.size[1]; j += 2) distances.fill(j, first_k);
    for (int k = first_k; k < std::min(first_k + 2, grid.size[2]); ++k) {
      const std::vector<std::int32_t> winding = inside.slice(k);
      for (int j = 0; j < grid.size[1]; ++j) {
        for (int i = 0; i < grid.size[0]; ++i) {
          const std::size_t place = i + static_cast<std::size_t>(grid.size[0] + 1) * j;
          if (winding[place] == 0) grid.at(i, j, k) *= -1;
        }
      }
    }
  });
  return grid;
}

}  // namespace fracbench
