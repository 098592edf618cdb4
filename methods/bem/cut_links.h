#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "core/voxel_grid.h"

namespace fracbench::bem {

/// The body as a grid of voxels joined by links to their six neighbours. A crack cuts the links
/// that its surface crosses; what stays joined is a fragment. No slab of material is lost.
class CutLinks {
 public:
  /// `body` must be closed. Throws InputError where the body is thinner than the voxels, naming
  /// the spacing (m) that would do, and where the grid would not fit into memory.
  CutLinks(const TriangleMesh& body, double spacing, int threads);

  double spacing() const { return spacing_; }

  /// Whether a point lies in the body (on the scale of a voxel).
  bool inside(const Vec3& point) const;

  /// Cuts every link that the triangle crosses, in the name of crack `crack` (>= 0). A link on the
  /// rim of two triangles that share an edge is cut by at least one of them. Links that are cut
  /// already keep their first crack.
  void cut(const std::array<Vec3, 3>& triangle, std::int32_t crack);

  /// The first crack other than `own` whose cut links the way from `from` to `to` crosses; -1:
  /// none. The way is at most a few voxels long.
  std::int32_t crack_between(const Vec3& from, const Vec3& to, std::int32_t own) const;

  /// Connected components of the voxels in the body, numbered from 1 by their first voxel; 0
  /// outside.
  VoxelGrid<std::int32_t> components() const;

 private:
  double spacing_ = 0;
};

}  // namespace fracbench::bem
