#pragma once

#include <chrono>
#include <string>

namespace fracbench {

/// What the machine does besides.
struct MachineLoad {
  double busy = 0;  ///< processors at work, 2.0: two of them
  double load = 0;  ///< load average of the last minute
  int processors = 1;

  /// Whether times that are measured now would count: at most a tenth of one processor at work.
  bool idle() const { return busy <= 0.1; }
  /// "2 processors, 1.31 of them at work, load average 2.40".
  std::string describe() const;
};

/// Watches the processors for that time, during which this process should do nothing. Zeros where
/// the system tells nothing.
MachineLoad measure_load(std::chrono::milliseconds time);

}  // namespace fracbench
