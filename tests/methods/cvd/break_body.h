#pragma once

#include <vector>

#include "core/breakable.h"
#include "core/impact.h"
#include "core/options.h"

namespace fracbench::test {

/// An impact of one impulse at a point, along x.
Impact push_at(const Vec3& point);

struct BreakOptions {
  OptionMap options;
  std::uint64_t seed = 1;
  int threads = 1;
};

/// Breaks a body with `cvd` under a push at its first vertex.
std::vector<Piece> break_body(const TriangleMesh& mesh, const BreakOptions& how);

}  // namespace fracbench::test
