#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace fracbench {

/// The right to make something, such as the record of a cell, held by one thread of one process on
/// one machine at a time. It is a lock (flock) on a file of its own, so that it ends with its
/// process however that ends.
class Claim {
 public:
  /// The claim of that file, unless somebody else holds it. Throws InputError where the file
  /// cannot be made or locked.
  static std::optional<Claim> try_take(const std::filesystem::path& file);

  ~Claim();
  Claim(Claim&& other) noexcept
      : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;
  Claim& operator=(Claim&&) = delete;

 private:
  Claim(std::filesystem::path file, int descriptor)
      : file_(std::move(file)), descriptor_(descriptor) {}

  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace fracbench
