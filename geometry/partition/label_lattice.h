#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "core/voxel_grid.h"

namespace fracbench::partition {

/// The part of a label volume that matters for a mesh: the samples inside it and around its
/// surface, every one of them with a region; all others belong to the void (region 0). The box has
/// a layer of void all around. A cell is the cube between eight samples; it has the index of its
/// lowest one.
struct LabelLattice {
  VoxelGrid<std::int32_t> region;            ///< 0: void, else 1 + index into `labels`
  std::vector<std::int32_t> labels;          ///< label numbers of the regions, ascending
  std::vector<std::int32_t> labels_outside;  ///< in the grid, but not inside the mesh
  std::size_t filled_voxels = 0;             ///< voxels inside the mesh that had no label
};

/// Throws InputError where mesh and labels do not fit together.
LabelLattice make_lattice(const TriangleMesh& mesh, const VoxelGrid<std::int32_t>& labels,
                          int threads);

/// Calls visit(cell) for every cell that the face may touch: those that meet its bounding box and
/// its plane. The face must lie in the grid.
template <typename T, typename Visit>
void for_each_touched_cell(const VoxelGrid<T>& grid, const TriangleMesh& mesh, std::size_t face,
                           const Visit& visit) {
  constexpr double slack = 1e-6;  // in cells: covers the rounding of these few lines
  const auto local = [&](int k) {
    return Vec3((mesh.corner(face, k) - grid.origin) / grid.spacing);
  };
  const Vec3 a = local(0), b = local(1), c = local(2);
  const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  const Vec3 n = (b - a).cross(c - a);
  const double norm = n.cwiseAbs().sum();
  const auto first = [&](int axis) { return static_cast<int>(std::floor(low[axis] - slack)); };
  const auto last = [&](int axis) { return static_cast<int>(std::floor(high[axis] + slack)); };
  const double reach = norm * (0.5 + slack), offset = n.dot(a);
  for (int k = first(2); k <= last(2); ++k) {
    for (int j = first(1); j <= last(1); ++j) {
      int i0 = first(0), i1 = last(0);
      // Cells of this row whose centre is within reach of the plane.
      if (std::abs(n.x()) > 1e-9 * norm) {
        const double middle = (offset - n.y() * (j + 0.5) - n.z() * (k + 0.5)) / n.x() - 0.5;
        const double half = reach / std::abs(n.x()) + slack;
        i0 = static_cast<int>(std::max<double>(i0, std::floor(middle - half)));
        i1 = static_cast<int>(std::min<double>(i1, std::ceil(middle + half)));
      }
      for (int i = i0; i <= i1; ++i) visit(grid.index(i, j, k));
    }
  }
}

}  // namespace fracbench::partition
