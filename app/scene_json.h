#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/impact.h"
#include "core/trajectory.h"

namespace fracbench {

/// What broke the body, and its pieces: of each break the time, the piece that broke (-1: the body
/// itself), the impulses with point, direction and magnitude, and the values of the break tests.
nlohmann::ordered_json impacts_json(const std::vector<Impact>& impacts);

/// The motion of all bodies: frame_seconds, and tracks with kind, index, first_frame and poses,
/// each [x, y, z, qw, qx, qy, qz], all in the normalised frame.
nlohmann::ordered_json trajectory_json(const Trajectory& trajectory);

}  // namespace fracbench
