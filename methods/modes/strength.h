#pragma once

namespace fracbench::modes {

/// What decides that a bond between two pieces breaks.
struct Strength {
  /// Break bonds whose velocities differ by `raw_threshold` or more, whatever the break test says;
  /// else the calibrated threshold, which goes by the impact's overload.
  bool raw = false;
  double raw_threshold = 0.02;  ///< m/s
};

}  // namespace fracbench::modes
