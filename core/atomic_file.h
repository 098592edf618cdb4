#pragma once

#include <cstddef>
#include <filesystem>
#include <mutex>
#include <span>
#include <string_view>
#include <vector>

namespace fracbench {

/// Writes a file that appears whole or not at all: the bytes go to a temporary file in the same
/// folder, are synced to the disk, and take the final name in one step, replacing a file that has
/// it. Where the path names a device or pipe, the bytes go straight to it.
/// Throws InputError, with the system's reason, where that cannot be done; nothing is left behind.
/// `temporary` is the name of the temporary file, for callers who know that nobody else uses it
/// and clean up after a process that was killed; by default it is one of this process's own.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           std::filesystem::path temporary = {});
/// The same of bytes in several places, one after another.
void write_file_atomically(const std::filesystem::path& path,
                           std::span<const std::string_view> parts,
                           std::filesystem::path temporary = {});

/// Many files, each of which appears whole or not at all, for one wait for the disk: those that
/// were added take their names together, when what is in them is on the disk. Safe to use from many
/// threads.
class AtomicFiles {
 public:
  AtomicFiles() = default;
  /// Removes what was added and not committed.
  ~AtomicFiles();
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;

  /// Throws what write_file_atomically throws. Now and then commits by itself.
  void add(const std::filesystem::path& path, std::string_view bytes);
  /// Likewise.
  void commit();

 private:
  struct Added {
    std::filesystem::path path, temporary;
    std::size_t size;
  };

  std::mutex mutex_;
  std::vector<Added> added_;
};

}  // namespace fracbench
