#include "methods/bem/crack_traces.h"

#include <array>
#include <cmath>

namespace fracbench::bem {
namespace {

constexpr double kCellSize = 2;      // reaches
constexpr double kParallel = 0.95;   // cosine between the normals
constexpr double kOwnCone = 0.75;    // tangent of the cone in which the own crack counts
constexpr double kOwnNearest = 0.2;  // reaches

}  // namespace

std::int64_t CrackTraces::key(std::int64_t i, std::int64_t j, std::int64_t k) const {
  constexpr std::int64_t kBias = 1 << 20;
  return ((i + kBias) << 42) ^ ((j + kBias) << 21) ^ (k + kBias);
}

void CrackTraces::add(const Trace& trace) {
  const Vec3 scaled = trace.position / (kCellSize * reach_);
  cells_[key(static_cast<std::int64_t>(std::floor(scaled[0])),
             static_cast<std::int64_t>(std::floor(scaled[1])),
             static_cast<std::int64_t>(std::floor(scaled[2])))]
      .push_back(trace);
}

std::optional<CrackTraces::Trace> CrackTraces::in_way(const Vec3& from, const Vec3& direction,
                                                      double length, const Vec3& normal,
                                                      std::int32_t own, bool with_own) const {
  const Vec3 end = from + length * direction;
  std::array<std::int64_t, 3> low{}, high{};
  for (int a = 0; a < 3; ++a) {
    const double size = kCellSize * reach_;
    low[a] = static_cast<std::int64_t>(std::floor((std::min(from[a], end[a]) - reach_) / size));
    high[a] = static_cast<std::int64_t>(std::floor((std::max(from[a], end[a]) + reach_) / size));
  }
  std::optional<Trace> first;
  double nearest = length + reach_;
  for (std::int64_t k = low[2]; k <= high[2]; ++k) {
    for (std::int64_t j = low[1]; j <= high[1]; ++j) {
      for (std::int64_t i = low[0]; i <= high[0]; ++i) {
        const auto cell = cells_.find(key(i, j, k));
        if (cell == cells_.end()) continue;
        for (const Trace& trace : cell->second) {
          if (trace.crack == own && !with_own) continue;
          const Vec3 apart = trace.position - from;
          const double ahead = apart.dot(direction);
          if (!(ahead > 0) || ahead >= nearest) continue;
          const double beside = (apart - ahead * direction).norm();
          if (beside > reach_ || std::abs(trace.normal.dot(normal)) < kParallel) continue;
          if (trace.crack == own && (ahead < kOwnNearest * reach_ || beside > kOwnCone * ahead)) {
            continue;
          }
          nearest = ahead;
          first = trace;
        }
      }
    }
  }
  return first;
}

}  // namespace fracbench::bem
