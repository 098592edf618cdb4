#pragma once

#include <sys/types.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace fracbench {

/// One that has ended and is not yet collected by its parent is not.
inline bool is_alive(::pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  return std::getline(stat, text) && text.at(text.rfind(')') + 2) != 'Z';
}

/// What is killed may take a moment to be gone, and longer on a busy machine.
inline bool all_gone(const std::vector<::pid_t>& processes) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < deadline) {
    if (std::ranges::none_of(processes, is_alive)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace fracbench
