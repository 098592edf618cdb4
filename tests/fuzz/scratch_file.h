#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/digest.h"

namespace fracbench::fuzz {

/// The input as text.
inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// The digest with which array files end.
inline std::string digest_of(const auto& value) {
  Digest digest;
  digest.add(value);
  return digest.hex();
}

inline std::string with_digest(std::string_view text) {
  return std::string(text) + digest_of(text);
}

/// A folder of this process in memory where there is one, removed when the process ends, for
/// readers that want a file.
class ScratchFolder {
 public:
  ScratchFolder() {
    const std::filesystem::path shm = "/dev/shm";
    folder_ = (std::filesystem::is_directory(shm) ? shm : std::filesystem::temp_directory_path()) /
              ("fracbench-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }

  /// Puts the input into a file of that name.
  std::filesystem::path write(std::string_view name, std::string_view bytes) const {
    const std::filesystem::path file = folder_ / name;
    std::ofstream(file, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
  }

 private:
  std::filesystem::path folder_;
};

inline const ScratchFolder& scratch() {
  static const ScratchFolder folder;
  return folder;
}

}  // namespace fracbench::fuzz
