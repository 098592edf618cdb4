#pragma once

#include <optional>
#include <string>

#include "core/impact.h"
#include "core/material.h"

namespace fracbench::modes {

/// What decides that a bond between two pieces breaks.
struct Strength {
  /// Break bonds whose velocities differ by `raw_threshold` or more, whatever the break test says;
  /// else the calibrated threshold.
  bool raw = false;
  double raw_threshold = 0.02;         ///< m/s
  std::string break_test = "authors";  ///< that of the scene: "authors", "eq2-face", "eq2-patch"
};

/// The sum of impulses at which an impact of this place and these directions would just break the
/// body by the break test, N s; nothing where the impact is weaker than that. The values of
/// `authors` and `eq2-face` grow in proportion to the impulse, those of `eq2-patch` with its fifth
/// root, since Hertz's patch grows with the power 4/5 of the speed.
std::optional<double> critical_impulse(const BreakTestValues& values, const Material& material,
                                       const std::string& break_test);

}  // namespace fracbench::modes
