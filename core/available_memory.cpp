#include "core/available_memory.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace fracbench {
namespace {

constexpr std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max();

/// The number after a word in a file of "word number" lines.
std::optional<std::uint64_t> number_after(const std::filesystem::path& file,
                                          std::string_view word) {
  std::ifstream input(file);
  std::string name;
  while (input >> name) {
    std::uint64_t value = 0;
    if (name == word && input >> value) return value;
    input.clear();
    input.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return std::nullopt;
}

std::optional<std::uint64_t> only_number(const std::filesystem::path& file) {
  std::ifstream input(file);
  std::uint64_t value = 0;
  if (input >> value) return value;
  return std::nullopt;  // no such file, or "max"
}

std::uint64_t left_on_machine() {
  const auto kibibytes = number_after("/proc/meminfo", "MemAvailable:");
  return kibibytes ? *kibibytes * 1024 : unknown;
}

/// Control groups, version 2, from the process's own up to the root.
std::uint64_t left_in_control_group() {
  std::ifstream input("/proc/self/cgroup");
  std::string line, group = "/";
  while (std::getline(input, line)) {
    if (line.starts_with("0::")) group = line.substr(3);
  }
  const std::filesystem::path root = "/sys/fs/cgroup";
  std::filesystem::path folder = root / std::filesystem::path(group).relative_path();
  std::uint64_t left = unknown;
  while (true) {
    const auto limit = only_number(folder / "memory.max");
    const auto used = only_number(folder / "memory.current");
    if (limit && used) {
      // Files kept in memory are counted as used, but given up when memory is wanted.
      const std::uint64_t files = number_after(folder / "memory.stat", "inactive_file").value_or(0);
      const std::uint64_t held = *used > files ? *used - files : 0;
      left = std::min(left, *limit > held ? *limit - held : 0);
    }
    if (folder == root || !folder.has_relative_path()) return left;
    folder = folder.parent_path();
  }
}

}  // namespace

std::uint64_t available_memory() { return std::min(left_on_machine(), left_in_control_group()); }

}  // namespace fracbench
