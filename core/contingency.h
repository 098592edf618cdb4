#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>

namespace fracbench {

/// How many places each part of two labellings has, and each pair of parts. Only places count where
/// both labels are >= 0.
struct Contingency {
  using Count = long long;
  std::map<std::int32_t, Count> a, b;
  std::map<std::pair<std::int32_t, std::int32_t>, Count> both;
  Count all = 0;
};

/// Of two labellings of the same places. Throws std::invalid_argument for different lengths.
Contingency contingency(std::span<const std::int32_t> a, std::span<const std::int32_t> b);

}  // namespace fracbench
