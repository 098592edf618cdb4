#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/triangle_mesh.h"
#include "core/voxel_grid.h"

namespace fracbench::bem {

/// The body as a grid of voxels joined by links to their six neighbours. A crack cuts the links
/// that its surface crosses; what stays joined is a fragment. No slab of material is lost.
///
/// Samples are placed off the body's planes of symmetry by a fixed part of a voxel, and every
/// crossing is decided by exact predicates with ties broken in one way (see line_crossing), so
/// that a watertight sheet of triangles that ends outside the body separates it.
class CutLinks {
 public:
  /// `body` must be closed. Throws InputError where the body is thinner than the voxels, naming
  /// the spacing (m) that would do, and where the grid would not fit into memory.
  CutLinks(const TriangleMesh& body, double spacing, int threads);

  double spacing() const { return inside_.spacing; }

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

  /// Calls visit(a, b, crack) for every cut link between two voxels of the body (indices into the
  /// grid of `components`, a < b), in ascending order.
  template <typename Visit>
  void for_each_cut(const Visit& visit) const {
    for (std::size_t i = 0; i < inside_.values.size(); ++i) {
      if (!inside_.values[i]) continue;
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t next = i + stride_[axis];
        if (links_[axis][i] < 0 || !inside_.values[next]) continue;
        visit(static_cast<std::int32_t>(i), static_cast<std::int32_t>(next),
              std::int32_t{links_[axis][i]});
      }
    }
  }

  /// Pairs of voxels (indices into the grid of `components`) whose link the triangle crosses, both
  /// in the body.
  std::vector<std::array<std::int32_t, 2>> crossed_by(const std::array<Vec3, 3>& triangle) const;

  /// 1: the sample lies in the body.
  const VoxelGrid<std::uint8_t>& voxels() const { return inside_; }

 private:
  using CrackId = std::int16_t;

  /// Whether two voxels in the body are joined: the link from `voxel` along `axis` is not cut.
  bool joined(std::size_t voxel, int axis) const {
    return inside_.values[voxel] && inside_.values[voxel + stride_[axis]] &&
           links_[axis][voxel] == free_;
  }
  void scan(const TriangleMesh& body);
  void join_chips(const VoxelGrid<std::int32_t>& parts, std::size_t solids);

  static constexpr CrackId free_ = -1;
  static constexpr CrackId surface_ = -2;  ///< the body's own surface runs between the voxels

  VoxelGrid<std::uint8_t> inside_;
  std::array<std::size_t, 3> stride_{};
  /// For every voxel and axis: the crack that cuts the link to the next voxel along the axis.
  std::array<std::vector<CrackId>, 3> links_;
  /// Pairs of voxels that are joined beside the links: chips that are joined to the body over
  /// necks finer than the voxels.
  std::vector<std::array<std::int32_t, 2>> bridges_;
};

}  // namespace fracbench::bem
