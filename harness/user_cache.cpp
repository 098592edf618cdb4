#include "harness/user_cache.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <system_error>

namespace fracbench {

namespace fs = std::filesystem;

std::optional<fs::path> user_cache_folder() {
  if (const char* named = std::getenv("FRACBENCH_CACHE")) {
    if (*named == '\0') return std::nullopt;
    return fs::path(named);
  }
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) {
    return fs::path(cache) / "fracbench";
  }
  if (const char* home = std::getenv("HOME"); home && *home) {
    return fs::path(home) / ".cache" / "fracbench";
  }
  return std::nullopt;
}

bool remove_cache_entry(const fs::path& folder) {
  std::error_code error;
  const bool there = fs::exists(folder, error);
  fs::remove_all(folder, error);
  return there && !error;
}

std::chrono::system_clock::time_point last_written(const fs::path& file) {
  std::error_code error;
  const auto time = fs::last_write_time(file, error);
  if (error) return {};
  return std::chrono::file_clock::to_sys(time);
}

void warn_of_cache(std::string_view text) { fmt::print(stderr, "fracbench: cache: {}\n", text); }

}  // namespace fracbench
