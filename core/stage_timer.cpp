#include "core/stage_timer.h"

#include <algorithm>

namespace fracbench {

StageTimer::Scope StageTimer::stage(std::string_view name) {
  charge_running();
  auto found = std::ranges::find(times_, name, &StageTime::name);
  if (found == times_.end()) found = times_.insert(found, StageTime{std::string(name), 0});
  running_.push_back(static_cast<std::size_t>(found - times_.begin()));
  return Scope(*this);
}

double StageTimer::total() const {
  double sum = 0;
  for (const StageTime& time : times_) sum += time.seconds;
  return sum;
}

void StageTimer::end() {
  charge_running();
  running_.pop_back();
}

void StageTimer::charge_running() {
  const Clock::time_point now = Clock::now();
  if (!running_.empty()) {
    times_[running_.back()].seconds += std::chrono::duration<double>(now - since_).count();
  }
  since_ = now;
}

}  // namespace fracbench
