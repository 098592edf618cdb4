#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/vec3.h"

namespace fracbench::bem {

/// Cauchy stress at points in or on the body, Pa, tension positive, in the body's frame; one
/// symmetric tensor for each point. May be called from one thread at a time.
using StressField = std::function<std::vector<Mat3>(std::span<const Vec3> points)>;

}  // namespace fracbench::bem
