#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// Label volumes written for tests.
namespace fracbench::test {

/// A file of its own for the test that is running, removed with the object.
class ScratchFile {
 public:
  explicit ScratchFile(std::string_view extension);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void write(std::string_view bytes) const;
  std::string read() const;

 private:
  std::filesystem::path path_;
};

std::string gzipped(std::string_view bytes);

/// The values as raw bytes of type T.
template <typename T>
std::string raw_bytes(const std::vector<std::int32_t>& values, bool is_big_endian = false) {
  std::string bytes;
  for (const std::int32_t value : values) {
    const auto wide = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      const std::size_t from = is_big_endian ? sizeof(T) - 1 - i : i;
      bytes.push_back(static_cast<char>(wide >> (8 * from) & 0xff));
    }
  }
  return bytes;
}

struct Hdf5Volume {
  std::array<hsize_t, 3> shape{2, 3, 4};  ///< nz, ny, nx
  hid_t type = H5T_STD_I32LE;
  std::vector<std::int64_t> values = {};  ///< none: nothing is written
  std::vector<double> origin = {-1, -0.5, 0.25};
  std::vector<double> spacing = {0.125};
  std::string name = "labels";
  bool compressed = false;
};

void write_hdf5(const std::filesystem::path& file, const Hdf5Volume& volume);

}  // namespace fracbench::test
