#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/vec3.h"

namespace fracbench::bem {

/// Points on the surfaces of cracks, laid as the fronts pass, and found by place. A front that runs
/// into a crack in nearly its own plane cuts no link of it: it is the points that stop it.
class CrackTraces {
 public:
  struct Trace {
    Vec3 position;
    Vec3 normal;  ///< of the crack's surface
    std::int32_t crack = -1;
  };

  /// Points closer than `reach` (m) to the way of a marker count.
  explicit CrackTraces(double reach) : reach_(reach) {}

  void add(const Trace& trace);

  /// The first point that lies in the way of a marker on crack `own`, which goes from `from` for
  /// `length` along `direction` and has the normal `normal`: ahead of it, at most `reach` beside
  /// the way and beyond its end, on a surface of about the same normal. Points of the own crack
  /// count where `with_own`, whatever their normal, but only in a narrow cone, since the front
  /// beside the marker may be ahead of it.
  std::optional<Trace> in_way(const Vec3& from, const Vec3& direction, double length,
                              const Vec3& normal, std::int32_t own, bool with_own) const;

 private:
  std::int64_t key(std::int64_t i, std::int64_t j, std::int64_t k) const;

  double reach_;
  std::unordered_map<std::int64_t, std::vector<Trace>> cells_;  ///< only ever looked up by cell
};

}  // namespace fracbench::bem
