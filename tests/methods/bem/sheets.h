#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/vec3.h"

namespace fracbench::test {

/// Triangles of a rectangle of `count` x `count` squares; `point(s, t)` places it, s and t in
/// [-1, 1]. Neighbours share their corners bit for bit.
inline std::vector<std::array<Vec3, 3>> sheet(int count,
                                              const std::function<Vec3(double, double)>& point) {
  const auto at = [&](int i, int j) { return point(2.0 * i / count - 1, 2.0 * j / count - 1); };
  std::vector<std::array<Vec3, 3>> triangles;
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      const Vec3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return triangles;
}

}  // namespace fracbench::test
