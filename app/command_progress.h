#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/progress.h"

namespace fracbench {

/// Shows on standard error how far one piece of work is, once it takes longer than two seconds: a
/// line that changes on a terminal, else a line every five seconds.
class CommandProgress final : public Progress {
 public:
  CommandProgress();
  /// Removes the line that changes.
  ~CommandProgress() override;
  CommandProgress(const CommandProgress&) = delete;
  CommandProgress& operator=(const CommandProgress&) = delete;

  void update(std::string_view what, double fraction) override;

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  bool shown_ = false;
  std::string what_;
  Clock::time_point begin_;  ///< of `what_`
  double first_ = 0;         ///< how much of it was done then, where it goes on from before
  Clock::time_point last_;
};

}  // namespace fracbench
