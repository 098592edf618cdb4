#pragma once

#include <cstdint>
#include <optional>

#include "methods/bem/crack_growth.h"

namespace fracbench::bem {

/// Where a marker ends that runs out of the body or into another crack.
struct FrontStop {
  Vec3 position;
  FrontState state;
};

/// Where a marker ends that has just left the body at `exit`, going into `direction`: farther out,
/// so that the crack cuts every link there. The way out goes into the middle between its direction
/// and the way straight away from the body, since a marker that leaves at a grazing angle would not
/// get away from its voxels; at least two voxels, and on until there is no body beside the crack's
/// plane either, since a plane that leaves at a grazing angle would not get away.
Vec3 beyond_surface(const Vec3& exit, const FrontMarker& marker, const Vec3& direction,
                    const CutLinks& links);

/// Where a marker of crack `id`, which is in the body, ends when it goes into `direction` for
/// `length`; empty where nothing is in the way. `forward`: the way is that of the front, so that
/// the crack itself may be in the way.
std::optional<FrontStop> stop_on_way(const FrontMarker& marker, const Vec3& direction,
                                     double length, bool forward, std::int32_t id,
                                     const CrackSpace& space);

}  // namespace fracbench::bem
