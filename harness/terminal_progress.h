#pragma once

#include <chrono>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>

#include "harness/runner.h"

namespace fracbench {

/// Shows how far a run is: one line that changes on a terminal, else a line every few seconds.
class TerminalProgress {
 public:
  using Describe = std::function<std::string(const RunProgress&)>;

  /// `terminal`: whether `out` is one; `columns`: how wide; `describe`: what the line says.
  TerminalProgress(std::ostream& out, bool terminal, int columns = 80, Describe describe = {});
  /// Leaves the line.
  ~TerminalProgress();
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  void update(const RunProgress& progress);
  /// A line that stays.
  void message(std::string_view text);

 private:
  void clear_line();

  std::ostream& out_;
  bool terminal_;
  int columns_;
  Describe describe_;
  bool line_shown_ = false;
  std::size_t last_done_ = 0;
  std::chrono::steady_clock::time_point last_line_;
};

/// For standard error: a terminal with its width where it is one.
bool is_terminal(int descriptor);
int terminal_columns(int descriptor);

/// "[ 12/40] 30 %, 2 failed, 1 min 20 s left; pot single-3 cvd".
std::string describe(const RunProgress& progress);

}  // namespace fracbench
