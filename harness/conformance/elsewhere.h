#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace fracbench::conformance {

/// The current folder, HOME and TMPDIR are below `folder` while it lives.
class Elsewhere {
 public:
  explicit Elsewhere(const std::filesystem::path& folder);
  ~Elsewhere();
  Elsewhere(const Elsewhere&) = delete;
  Elsewhere& operator=(const Elsewhere&) = delete;

 private:
  static constexpr std::array<const char*, 2> kNames{"HOME", "TMPDIR"};
  std::filesystem::path before_;
  std::array<std::optional<std::string>, 2> values_;
};

}  // namespace fracbench::conformance
