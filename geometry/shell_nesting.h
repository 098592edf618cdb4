#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

enum class PointSide { outside, inside, on_surface };

/// On which side of the closed surface made of the given faces a point lies: the parity of the
/// crossings of a vertical ray, with exact predicates and a symbolic perturbation, so that it is
/// right for every point. Linear in the number of faces. (For many queries: SurfaceDistance.)
PointSide point_side(const TriangleMesh& mesh, std::span<const std::int32_t> faces,
                     const Vec3& point);

/// How the closed shells (edge-connected components) of a mesh lie in each other.
struct ShellNesting {
  struct Shell {
    std::vector<std::int32_t> faces;  ///< ascending
    double volume = 0;                ///< signed, m^3
    std::int32_t depth = 0;           ///< number of other shells that it lies in
    std::int32_t parent = -1;         ///< the innermost of them
  };
  std::vector<Shell> shells;  ///< in the order of face_components
};

/// `component`: the result of face_components(mesh). The shells must be closed and must not cross
/// each other; they may touch.
ShellNesting shell_nesting(const TriangleMesh& mesh, std::span<const std::int32_t> component);

}  // namespace fracbench
