#pragma once

#include <cstdint>
#include <memory>

#include "core/triangle_mesh.h"

namespace fracbench {

/// Distances to a mesh, for repeated use. Safe to query from many threads.
class SurfaceDistance {
 public:
  /// Copies what it needs from `mesh`, which must not be empty.
  explicit SurfaceDistance(const TriangleMesh& mesh);
  ~SurfaceDistance();
  SurfaceDistance(SurfaceDistance&&) noexcept;
  SurfaceDistance& operator=(SurfaceDistance&&) noexcept;

  struct Nearest {
    Vec3 point;  ///< on the surface
    std::int32_t face = -1;
    double distance = 0;  ///< m, not signed
  };
  Nearest nearest(const Vec3& query) const;

  /// Whether the point is inside the closed mesh; exact up to the rounding of the query itself
  /// (points on the surface may go either way).
  bool inside(const Vec3& query) const;

  /// Positive inside, negative outside (the paper's convention), m.
  double signed_distance(const Vec3& query) const;

  /// The first face that the ray from `origin` along `direction` meets.
  struct Hit {
    double t = 0;            ///< origin + t * direction is the hit point; t >= 0
    std::int32_t face = -1;  ///< -1: none
  };
  Hit first_hit(const Vec3& origin, const Vec3& direction) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace fracbench
