#pragma once

#include "methods/bem/crack_growth.h"

namespace fracbench::bem {

/// Gives a new crack, of which only the fine surface and the markers are there, its coarse sheet: a
/// fan from the middle of the front, or from `center` where that sees more of it.
void mesh_disc(Crack& crack, const Vec3& center);

/// Takes boundary and states of the coarse sheet from the markers.
void update_boundary(Crack& crack);

/// Indices of the markers that are vertices of the coarse sheet, in order.
std::vector<std::size_t> coarse_markers(const Crack& crack);

}  // namespace fracbench::bem
