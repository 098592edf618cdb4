#include "geometry/read_label_volume.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "geometry/label_volume/hdf5_volume.h"
#include "geometry/label_volume/nrrd_volume.h"

namespace fracbench {

VoxelGrid<std::int32_t> read_label_volume(const std::filesystem::path& file) {
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) {
    throw InputError(fmt::format("{}: there is no such file", file.string()));
  }
  if (std::filesystem::is_directory(status)) {
    throw InputError(fmt::format("{}: is a folder; give the file of the labels", file.string()));
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError(
        fmt::format("{}: is a device or pipe; write the labels to a file first", file.string()));
  }
  std::ifstream input(file, std::ios::binary);
  std::array<char, 8> start{};
  input.read(start.data(), start.size());
  if (input.bad() || !input.is_open()) {
    throw InputError(fmt::format("{}: cannot be read", file.string()));
  }
  const std::string_view bytes(start.data(), static_cast<std::size_t>(input.gcount()));
  if (bytes.empty()) throw InputError(fmt::format("{}: is empty", file.string()));
  if (bytes.starts_with("NRRD")) return read_nrrd_volume(file);
  if (is_hdf5(file)) return read_hdf5_volume(file);
  throw InputError(fmt::format(
      "{}: is neither an NRRD nor an HDF5 file; write the labels as one of these", file.string()));
}

}  // namespace fracbench
