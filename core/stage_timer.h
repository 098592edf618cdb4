#pragma once

#include <chrono>
#include <string_view>
#include <vector>

#include "core/name.h"

namespace fracbench {

struct StageTime {
  Name name;
  double seconds = 0;
};

/// Where the time goes. A stage that starts inside another one pauses it, so that the times of all
/// stages add up and nothing is counted twice. For one thread; parallel work is timed from outside.
class StageTimer {
 public:
  /// Ends its stage when it goes out of scope.
  class [[nodiscard]] Scope {
   public:
    explicit Scope(StageTimer& timer) : timer_(&timer) {}
    ~Scope() { timer_->end(); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    StageTimer* timer_;
  };

  Scope stage(std::string_view name);

  /// In the order in which the stages first started; stages of one name are summed.
  const std::vector<StageTime>& times() const { return times_; }
  /// Sum over all stages, s.
  double total() const;

 private:
  using Clock = std::chrono::steady_clock;

  void end();
  void charge_running();

  std::vector<StageTime> times_;
  std::vector<std::size_t> running_;  ///< innermost last; indices into times_
  Clock::time_point since_;
};

}  // namespace fracbench
