#include "geometry/partition/kuhn_cell.h"

#include <algorithm>
#include <cmath>

#include "core/vec3.h"

namespace fracbench::partition {
namespace {

Vec3 corner(int bits) { return Vec3(bits & 1, bits >> 1 & 1, bits >> 2 & 1); }

bool connected(int mask) {
  int reached = mask & -mask;
  for (int round = 0; round < 8; ++round) {
    for (int c = 0; c < 8; ++c) {
      if (!(reached >> c & 1)) continue;
      for (int axis = 0; axis < 3; ++axis) reached |= 1 << (c ^ (1 << axis)) & mask;
    }
  }
  return reached == mask;
}

bool has_ambiguous_side(int mask) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
    for (int base : {0, 1 << axis}) {
      const auto in = [&](int c) { return mask >> c & 1; };
      if (in(base) == in(base | u | v) && in(base | u) == in(base | v) &&
          in(base) != in(base | u)) {
        return true;
      }
    }
  }
  return false;
}

KuhnTables make_tables() {
  KuhnTables tables;
  std::array<int, 3> axes = {0, 1, 2};
  for (int t = 0; t < 6; ++t) {
    const int a = 1 << axes[0], b = 1 << axes[1];
    tables.tetrahedron[t] = {0, static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(a | b), 7};
    std::next_permutation(axes.begin(), axes.end());
  }
  int kinds = 0;
  for (int second = 1; second < 8; ++second) {
    for (int first = 1; first < second; ++first) {
      if ((first & second) != first) continue;
      tables.triangle_steps[kinds++] = {static_cast<std::uint8_t>(first),
                                        static_cast<std::uint8_t>(second)};
    }
  }
  for (int mask = 0; mask < 256; ++mask) {
    tables.simple[mask] = connected(mask) && connected(255 & ~mask) && !has_ambiguous_side(mask);
  }

  for (int d = 1; d < 8; ++d) {
    struct Around {
      RingStep step;
      double angle;
    };
    std::vector<Around> around;
    const Vec3 axis = corner(d).normalized();
    const Vec3 u = axis.unitOrthogonal(), w = axis.cross(u);
    for (int off = 0; off < 8; ++off) {
      if (off & d) continue;
      for (int t = 0; t < 6; ++t) {
        const auto& chain = tables.tetrahedron[t];
        if (std::find(chain.begin(), chain.end(), off) == chain.end()) continue;
        if (std::find(chain.begin(), chain.end(), off | d) == chain.end()) continue;
        Vec3 middle = Vec3::Zero();
        for (const int c : chain) middle += (corner(c) - corner(off)) / 4;
        RingStep step;
        step.cell = static_cast<std::uint8_t>(off);
        step.tetrahedron = static_cast<std::uint8_t>(t);
        around.push_back({step, std::atan2(middle.dot(w), middle.dot(u))});
      }
    }
    std::sort(around.begin(), around.end(),
              [](const Around& l, const Around& r) { return l.angle < r.angle; });
    for (std::size_t n = 0; n < around.size(); ++n) {
      RingStep step = around[n].step;
      const RingStep& next = around[(n + 1) % around.size()].step;
      // The three corners, relative to the edge's start, that both tetrahedra have.
      std::vector<Eigen::Vector3i> shared;
      for (const int c : tables.tetrahedron[step.tetrahedron]) {
        for (const int e : tables.tetrahedron[next.tetrahedron]) {
          const Vec3 p = corner(c) - corner(step.cell), q = corner(e) - corner(next.cell);
          if (p == q) shared.push_back(p.cast<int>());
        }
      }
      std::sort(shared.begin(), shared.end(),
                [](const auto& l, const auto& r) { return l.sum() < r.sum(); });
      const auto bits = [](const Eigen::Vector3i& v) { return v[0] + 2 * v[1] + 4 * v[2]; };
      step.triangle_base = static_cast<std::uint8_t>(bits(-shared[0]));
      const int first = bits(shared[1] - shared[0]), second = bits(shared[2] - shared[0]);
      for (int kind = 0; kind < 12; ++kind) {
        if (tables.triangle_steps[kind][0] == first && tables.triangle_steps[kind][1] == second) {
          step.triangle_kind = static_cast<std::uint8_t>(kind);
        }
      }
      tables.ring[d].push_back(step);
    }
  }
  return tables;
}

}  // namespace

const KuhnTables& kuhn_tables() {
  static const KuhnTables tables = make_tables();
  return tables;
}

}  // namespace fracbench::partition
