#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench::modes {

/// The fans of faces around the vertex `center`, of a surface that bounds a solid: for each face
/// the number of its fan, 0, 1, ... in the order of their first faces. Neighbours across an edge at
/// the vertex are in one fan. Where four or more faces meet in an edge, the solid touches itself
/// there; then those faces are neighbours that bound the same wedge of it, so that a copy of the
/// vertex for each fan leaves a manifold.
/// Every face has `center` among its corners, and for every edge as many faces run towards the
/// vertex as away from it.
std::vector<std::int32_t> fans_at(std::int32_t center, std::span<const Face> faces,
                                  std::span<const Vec3> vertices);

/// Whether the faces around `center` are one fan in which no edge has more than two faces: the
/// common case, found quickly. False may also mean that there are too many faces to see quickly.
bool is_plain_fan(std::int32_t center, std::span<const Face> faces);

}  // namespace fracbench::modes
