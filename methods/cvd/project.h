#pragma once

#include "core/vec3.h"

namespace fracbench::cvd {

/// Two coordinates that show a plane from the side that its normal points to, so that turns keep
/// their sense. No coordinate is rounded.
struct Axes {
  int u = 0;
  int v = 1;
};

inline Axes dominant_axes(const Vec3& normal) {
  int w = 0;
  normal.cwiseAbs().maxCoeff(&w);
  const int u = (w + 1) % 3, v = (w + 2) % 3;
  return normal[w] > 0 ? Axes{u, v} : Axes{v, u};
}

}  // namespace fracbench::cvd
