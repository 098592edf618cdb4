#pragma once

#include <cstddef>
#include <vector>

#include "methods/cvd/surface_topology.h"

namespace fracbench::cvd {

/// About `count` points spread evenly through a solid, always the same ones for the same body: on
/// lines along the longest axis of its box, in the middle of equal columns, each with an offset of
/// its own from the R2 low-discrepancy sequence. At least `minimum` points, else throws
/// MethodFailure.
std::vector<Vec3> interior_samples(const SurfaceTopology& body, std::size_t count,
                                   std::size_t minimum);

}  // namespace fracbench::cvd
