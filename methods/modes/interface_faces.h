#pragma once

#include <cstdint>
#include <span>

#include "geometry/partition/interfaces.h"
#include "methods/modes/tet_mesh.h"

namespace fracbench::modes {

/// The tets' faces between different regions, in the body's frame; region r of a tet is 1 + r in
/// the complex. So that nothing coincides with the body's own vertices and edges, vertices on the
/// boundary of the tets move outward by `shift` (a share of the frame's size), and all vertices by
/// up to a tenth of that at random: where the tets fill the shape itself instead of a cage around
/// it, the interfaces still end outside the body.
partition::InterfaceComplex interface_faces(const TetMesh& tets,
                                            std::span<const std::int32_t> region_of_tet,
                                            double shift, std::uint64_t salt);

/// The tet that holds a point of the body's frame, or is nearest to holding it.
std::int32_t tet_at(const TetMesh& tets, const Vec3& point);

}  // namespace fracbench::modes
