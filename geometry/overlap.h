#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// Two solids that share more than their surfaces.
struct Overlap {
  std::int32_t first = 0;  ///< numbers of the solids, first < second
  std::int32_t second = 0;
  Vec3 place;        ///< a point that is inside one and inside, or on the surface of, the other
  double depth = 0;  ///< of the place under the surface of the one that it was tested against, m
};

struct OverlapOptions {
  double tolerance = 1e-6;  ///< m; solids that merely touch interpenetrate by rounding
  int threads = 2;
};

/// The pairs of closed meshes that overlap, in ascending order, each with the first place found.
/// Two solids overlap when a point of one is deeper than the tolerance inside the other. Tried are
/// all vertices, the middles of all faces, the middle of every stretch of every edge between the
/// faces of the other solid, and a point of the interior, each of either solid: an overlap that
/// contains none of them is not found, which takes a face of one solid that crosses the other
/// without an edge of either doing so.
std::vector<Overlap> find_overlaps(
    std::span<const std::reference_wrapper<const TriangleMesh>> solids,
    const OverlapOptions& options = {});

}  // namespace fracbench
