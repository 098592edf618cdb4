#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// For each vertex the first vertex with the same coordinates (0 and -0 are the same; a vertex with
/// a NaN is like no other).
std::vector<std::int32_t> first_equal_vertex(const std::vector<Vec3>& vertices);

}  // namespace fracbench
