#pragma once

#include <algorithm>
#include <chrono>

namespace fracbench {

/// The shortest time that an attempt returned. There are five at most, none after one within the
/// limit: other work on the machine may delay some of them, though hardly all.
template <typename Attempt>
std::chrono::duration<double> best_time(std::chrono::duration<double> limit,
                                        const Attempt& attempt) {
  std::chrono::duration<double> best = attempt();
  for (int k = 1; k < 5 && best >= limit; ++k) {
    best = std::min(best, std::chrono::duration<double>(attempt()));
  }
  return best;
}

}  // namespace fracbench
