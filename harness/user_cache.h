#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace fracbench {

/// The folder of what is kept on the disk for all suites of a user (docs/cache.md): the one that
/// FRACBENCH_CACHE names, else fracbench below XDG_CACHE_HOME or ~/.cache. None where
/// FRACBENCH_CACHE is empty, or there is no home.
std::optional<std::filesystem::path> user_cache_folder();

/// What is kept under one key, as `fracbench cache` shows it.
struct CacheEntry {
  std::string key;
  std::string method;
  std::string shape;
  std::optional<double> seconds = {};  ///< that making it took, where that is known
  /// How many there are to learn from; none where it is a prepared body.
  std::optional<std::size_t> collisions = {};
  std::uintmax_t bytes = 0;
  std::chrono::system_clock::time_point used = {};  ///< when it was last made or read
  std::string complaint = {};                       ///< what is wrong with it; empty: nothing
};

/// Removes the folder of an entry. False where it is not there or cannot be removed.
bool remove_cache_entry(const std::filesystem::path& folder);

/// When a file was last written; the beginning of time where it is not there.
std::chrono::system_clock::time_point last_written(const std::filesystem::path& file);

/// One line on standard error.
void warn_of_cache(std::string_view text);

}  // namespace fracbench
