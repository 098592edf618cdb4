#pragma once

#include <array>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>

#include "core/vec3.h"

namespace fracbench {

/// What an NRRD header says about a volume of labels
/// (http://teem.sourceforge.net/nrrd/format.html).
struct NrrdHeader {
  enum class Encoding : std::uint8_t { raw, gzip, text };

  int bytes = 0;  ///< of one value
  bool is_signed = false;
  bool is_big_endian = false;
  Encoding encoding = Encoding::raw;
  std::array<std::uint64_t, 3> sizes{};
  Vec3 origin = Vec3::Zero();  ///< centre of the first voxel
  double spacing = 0;
};

/// Reads the header, and leaves the stream at the first byte of the data. `file` is its name in
/// messages. Throws InputError, naming field and value, for a header that is damaged or describes
/// something else than one volume of integers in cubic voxels along x, y and z, the data attached.
NrrdHeader read_nrrd_header(std::istream& input, std::string_view file);

}  // namespace fracbench
