#include "core/peak_memory.h"

#include <fstream>
#include <string>

namespace fracbench {

void reset_peak_memory() {
  // "5" resets VmHWM, see proc(5).
  std::ofstream("/proc/self/clear_refs") << "5";
}

std::uint64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stoull(line.substr(6)) * 1024;
  }
  return 0;
}

}  // namespace fracbench
