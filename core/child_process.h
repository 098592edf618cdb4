#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace fracbench {

struct ChildOptions {
  std::filesystem::path folder = {};  ///< that it works in; empty: the current one
  std::stop_token stop = {};
  /// Told each line of standard output, without its end; empty: they are thrown away.
  std::function<void(std::string_view line)> on_line = {};
};

/// How a program ended.
struct ChildResult {
  int exit_code = 0;  ///< where no signal ended it
  int signal = 0;     ///< that ended it; 0: none
  std::string said;   ///< the end of what it wrote to standard error, 2000 characters at most

  bool good() const { return signal == 0 && exit_code == 0; }
  /// "with exit code 3: what it said" or "by signal 11".
  std::string describe() const;
};

/// Runs a program to its end, with /dev/null as its input and in a process group of its own, which
/// ends with this call in any case; when it is ended before its time, so are all its descendants.
/// The first argument is the program, looked for in PATH where it names no folder. Throws
/// Cancelled, within a tenth of a second, when asked to stop, and std::system_error where the
/// program cannot be started.
ChildResult run_child(std::vector<std::string> arguments, const ChildOptions& options = {});

}  // namespace fracbench
