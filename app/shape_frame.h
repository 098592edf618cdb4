#pragma once

#include <span>
#include <vector>

#include "core/fragments.h"
#include "core/triangle_mesh.h"

namespace fracbench {

/// A mesh as the user gave it and as methods see it: centred, its longest side 1.9. Keeps both, so
/// that fragments can go back to the place and scale of the user's mesh with every one of its
/// vertices bit for bit.
class ShapeFrame {
 public:
  explicit ShapeFrame(TriangleMesh own, double longest_side = 1.9);

  const TriangleMesh& own() const { return own_; }
  const TriangleMesh& normalized() const { return normalized_; }

  TriangleMesh to_own(const TriangleMesh& mesh) const;
  TriangleMesh to_normalized(const TriangleMesh& mesh) const;
  /// Length in the user's units of one metre of the normalised frame.
  double scale() const { return scale_; }

 private:
  TriangleMesh own_;
  TriangleMesh normalized_;
  Vec3 center_;
  double scale_;
  std::vector<std::int32_t> by_position_;  ///< vertices of normalized_, sorted by coordinates
};

}  // namespace fracbench
