#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/triangle_mesh.h"

namespace fracbench {

/// SHA-256 over a sequence of values. Every value goes in with its length, so that ("ab", "c") and
/// ("a", "bc") differ.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;

  void add(std::span<const std::byte> bytes);
  void add(std::string_view text);
  /// As one text, one after another.
  void add(std::span<const std::string_view> parts);
  /// The bytes of a file, as one text; it need not fit into memory. Throws InputError where it
  /// cannot be read.
  void add_file(const std::filesystem::path& file);
  void add(std::uint64_t value);
  void add(double value);
  void add(const TriangleMesh& mesh);

  /// 64 hexadecimal digits. Nothing can be added afterwards.
  std::string hex();
  /// The first eight bytes as a number. Nothing can be added afterwards.
  std::uint64_t word();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace fracbench
