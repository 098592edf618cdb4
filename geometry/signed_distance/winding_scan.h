#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/triangle_mesh.h"
#include "core/voxel_grid.h"

namespace fracbench {

/// Winding numbers of closed surfaces at the samples of a grid, by the faces that each line of
/// samples along x crosses. Exact, but that samples on the surface may go either way.
class WindingScan {
 public:
  /// Each face counts `weight` times; without weights, once. Keeps a reference to the mesh.
  template <typename T>
  WindingScan(const TriangleMesh& mesh, const VoxelGrid<T>& grid,
              std::vector<std::int32_t> weights = {})
      : mesh_(mesh), weights_(std::move(weights)), faces_of_slice_(grid.size[2]) {
    // In ascending order, exactly as VoxelGrid::position rounds them.
    for (int i = 0; i < grid.size[0]; ++i) x_.push_back(grid.position(i, 0, 0).x());
    for (int j = 0; j < grid.size[1]; ++j) y_.push_back(grid.position(0, j, 0).y());
    for (int k = 0; k < grid.size[2]; ++k) z_.push_back(grid.position(0, 0, k).z());
    sort_faces();
  }

  /// Winding numbers at the samples of slice k: sample (i, j) at i + row() * j.
  std::vector<std::int32_t> slice(int k) const;
  std::size_t row() const { return x_.size() + 1; }

 private:
  void sort_faces();
  std::size_t first_beyond(std::int32_t face, int crossing, int j, int k) const;

  const TriangleMesh& mesh_;
  std::vector<std::int32_t> weights_;
  std::vector<double> x_, y_, z_;
  std::vector<std::vector<std::int32_t>> faces_of_slice_;
};

}  // namespace fracbench
