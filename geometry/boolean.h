#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

enum class BooleanOperation { intersection, union_of, difference };

/// A boolean of two closed solids, and where each face came from.
struct BooleanResult {
  TriangleMesh mesh;
  /// Parallel to mesh.faces: a face of `a` (>= 0), or -1 - (a face of `b`).
  std::vector<std::int32_t> source_face;
};

/// Exact predicates and constructions (CGAL corefinement); vertices of the inputs are kept bit for
/// bit. Throws MethodFailure where CGAL cannot give a closed result, with the reason.
BooleanResult boolean(const TriangleMesh& a, const TriangleMesh& b, BooleanOperation operation);

}  // namespace fracbench
