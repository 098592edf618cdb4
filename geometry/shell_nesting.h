#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

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
/// each other; they may touch. Exact predicates; which way the faces are turned does not matter.
ShellNesting shell_nesting(const TriangleMesh& mesh, std::span<const std::int32_t> component);

}  // namespace fracbench
