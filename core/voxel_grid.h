#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace fracbench {

/// Samples on a regular grid, x fastest: value (i, j, k) belongs to origin + spacing * (i, j, k).
template <typename T>
struct VoxelGrid {
  std::array<std::int32_t, 3> size{0, 0, 0};
  Vec3 origin = Vec3::Zero();  ///< position of sample (0, 0, 0)
  double spacing = 1;          ///< m
  std::vector<T> values;

  VoxelGrid() = default;
  VoxelGrid(std::array<std::int32_t, 3> size_, const Vec3& origin_, double spacing_, T fill = T{})
      : size(size_),
        origin(origin_),
        spacing(spacing_),
        values(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], fill) {}

  std::size_t index(int i, int j, int k) const {
    return i + static_cast<std::size_t>(size[0]) * (j + static_cast<std::size_t>(size[1]) * k);
  }
  T& at(int i, int j, int k) { return values[index(i, j, k)]; }
  const T& at(int i, int j, int k) const { return values[index(i, j, k)]; }
  Vec3 position(int i, int j, int k) const { return origin + spacing * Vec3(i, j, k); }
};

/// The r^3 grid on the cube [-1, 1]^3 with samples at the voxels' centres, on which signed
/// distances and label volumes live unless something else is said.
template <typename T>
VoxelGrid<T> unit_grid(int r, T fill = T{}) {
  const double spacing = 2.0 / r;
  return VoxelGrid<T>({r, r, r}, Vec3::Constant(-1 + spacing / 2), spacing, fill);
}

}  // namespace fracbench
