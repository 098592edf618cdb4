#pragma once

#include <filesystem>
#include <string_view>

namespace fracbench {

/// A new folder below that of temporary files (TMPDIR), removed with everything in it.
class TemporaryWorkFolder {
 public:
  /// Throws InputError where it cannot be made.
  explicit TemporaryWorkFolder(std::string_view purpose);
  ~TemporaryWorkFolder();
  TemporaryWorkFolder(const TemporaryWorkFolder&) = delete;
  TemporaryWorkFolder& operator=(const TemporaryWorkFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_;  ///< released by the system, too, when the process is killed
};

/// Removes such folders, of this user, that processes left which were killed.
void remove_abandoned_work_folders();

}  // namespace fracbench
