#include "methods/modes/strength.h"

#include <algorithm>
#include <cmath>

namespace fracbench::modes {
namespace {

// Of the test `authors`, as in the scenes.
constexpr double kBreakingImpulse = 1e5;  // N s
constexpr double kBreakingForce = 1e7;    // N

}  // namespace

std::optional<double> critical_impulse(const BreakTestValues& values, const Material& material,
                                       const std::string& break_test) {
  double excess = 0;  // the impulse over the critical one
  if (break_test == "authors") {
    excess =
        std::max(values.total_impulse / kBreakingImpulse, values.balanced_force / kBreakingForce);
    if (excess < 1) return std::nullopt;
  } else {
    const bool patch = break_test == "eq2-patch";
    const double ratio =
        (patch ? values.eq2_patch_stress : values.eq2_face_stress) / material.strength;
    if (!(ratio > 1)) return std::nullopt;
    excess = patch ? std::pow(ratio, 5) : ratio;
  }
  return values.total_impulse / excess;
}

}  // namespace fracbench::modes
