#include "core/contingency.h"

#include <stdexcept>

namespace fracbench {

Contingency contingency(std::span<const std::int32_t> a, std::span<const std::int32_t> b) {
  if (a.size() != b.size()) throw std::invalid_argument("labellings of different lengths");
  Contingency counts;
  // Neighbours mostly belong together: a step in the map for each run of equal pairs.
  for (std::size_t begin = 0, end = 0; begin < a.size(); begin = end) {
    while (end < a.size() && a[end] == a[begin] && b[end] == b[begin]) ++end;
    if (a[begin] < 0 || b[begin] < 0) continue;
    counts.both[{a[begin], b[begin]}] += static_cast<Contingency::Count>(end - begin);
  }
  for (const auto& [pair, count] : counts.both) {
    counts.a[pair.first] += count;
    counts.b[pair.second] += count;
    counts.all += count;
  }
  return counts;
}

}  // namespace fracbench
