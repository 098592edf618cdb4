#pragma once

#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace fracbench {

/// The motion of one body: poses of its mesh frame, one per frame from first_frame on. The track
/// ends when the body breaks.
struct Track {
  enum class Kind : std::uint8_t { target, ball, piece };
  Kind kind = Kind::target;
  std::int32_t index = 0;  ///< which ball, or the running number of the piece
  std::int32_t first_frame = 0;
  std::vector<Pose> poses;
};

/// The motion of a whole scene.
struct Trajectory {
  double frame_seconds = 0;  ///< time between two frames
  std::vector<Track> tracks;
};

}  // namespace fracbench
