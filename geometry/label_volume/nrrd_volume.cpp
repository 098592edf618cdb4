#include "geometry/label_volume/nrrd_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "geometry/label_volume/checked_grid.h"
#include "geometry/label_volume/gzip_stream.h"
#include "geometry/label_volume/nrrd_header.h"

namespace fracbench {
namespace {

constexpr std::size_t chunk_bytes = 1 << 16;
constexpr std::uint64_t best_gzip_ratio = 1032;  // of deflate, for a file of one repeated byte

/// One value of a file, its bytes in the file's order.
std::uint64_t assembled(const char* bytes, const NrrdHeader& header) {
  std::uint64_t value = 0;
  for (int i = 0; i < header.bytes; ++i) {
    const int from = header.is_big_endian ? header.bytes - 1 - i : i;
    value |= std::uint64_t{static_cast<unsigned char>(bytes[from])} << (8 * i);
  }
  if (header.is_signed && header.bytes < 8 && (value >> (8 * header.bytes - 1) & 1) != 0) {
    value |= ~std::uint64_t{0} << (8 * header.bytes);
  }
  return value;
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : file_(path.string()), input_(path, std::ios::binary) {
    header_ = read_nrrd_header(input_, file_);
    const auto start = input_.tellg();
    input_.seekg(0, std::ios::end);
    left_ = static_cast<std::uint64_t>(input_.tellg() - start);
    input_.seekg(start);
    if (!input_) throw InputError(fmt::format("{}: cannot be read", file_));
  }

  VoxelGrid<std::int32_t> read() {
    const auto size = checked_size(header_.sizes, sizeof(std::int32_t), file_);
    count_ = static_cast<std::uint64_t>(size[0]) * size[1] * size[2];
    const std::uint64_t needed = least_bytes();
    if (left_ < needed) fail_short(fmt::format("{} bytes of data", left_));
    VoxelGrid<std::int32_t> labels(size, header_.origin, header_.spacing);
    if (header_.encoding == NrrdHeader::Encoding::raw) {
      if (left_ > needed) {
        throw InputError(fmt::format(
            "{}: sizes and type ask for {} bytes of data, but {} follow the header: one of the "
            "fields 'sizes' and 'type' is wrong",
            file_, needed, left_));
      }
      read_binary(labels.values, [&](char* to, std::size_t bytes) {
        input_.read(to, static_cast<std::streamsize>(bytes));
        return static_cast<std::size_t>(input_.gcount());
      });
    } else if (header_.encoding == NrrdHeader::Encoding::gzip) {
      GzipStream stream(input_, file_);
      read_binary(labels.values,
                  [&](char* to, std::size_t bytes) { return stream.read(to, bytes); });
      char extra = 0;
      if (stream.read(&extra, 1) != 0) {
        throw InputError(fmt::format(
            "{}: holds more data than the {} values that 'sizes' asks for: 'sizes' or 'type' is "
            "wrong",
            file_, count_));
      }
    } else {
      read_text(labels.values);
    }
    return labels;
  }

 private:
  /// Fewer bytes of data cannot hold the volume: known before memory is taken for it.
  std::uint64_t least_bytes() const {
    const std::uint64_t binary = count_ * static_cast<std::uint64_t>(header_.bytes);
    switch (header_.encoding) {
      case NrrdHeader::Encoding::raw:
        return binary;
      case NrrdHeader::Encoding::gzip:
        return binary / best_gzip_ratio;
      case NrrdHeader::Encoding::text:
        return 2 * count_ - 1;
    }
    return 0;
  }

  [[noreturn]] void fail_short(const std::string& what) const {
    throw InputError(fmt::format(
        "{}: is cut short: {} x {} x {} values of {} bytes are needed, "
        "and it holds {}",
        file_, header_.sizes[0], header_.sizes[1], header_.sizes[2], header_.bytes, what));
  }

  template <typename Value>
  std::int32_t label_from(Value value, std::size_t index) const {
    if (std::in_range<std::int32_t>(value)) return static_cast<std::int32_t>(value);
    const std::uint64_t nx = header_.sizes[0], ny = header_.sizes[1];
    throw InputError(
        fmt::format("{}: voxel ({}, {}, {}) holds {}; labels are 32-bit integers: renumber them",
                    file_, index % nx, index / nx % ny, index / nx / ny, value));
  }

  template <typename ReadBytes>
  void read_binary(std::vector<std::int32_t>& labels, const ReadBytes& read_bytes) const {
    std::vector<char> chunk(chunk_bytes);
    const auto width = static_cast<std::size_t>(header_.bytes);
    for (std::size_t done = 0; done < labels.size();) {
      const std::size_t values = std::min(chunk_bytes / width, labels.size() - done);
      const std::size_t got = read_bytes(chunk.data(), values * width);
      if (got != values * width) fail_short(fmt::format("{} whole values", done + got / width));
      for (std::size_t i = 0; i < values; ++i) {
        const std::uint64_t value = assembled(&chunk[i * width], header_);
        labels[done + i] = header_.is_signed
                               ? label_from(static_cast<std::int64_t>(value), done + i)
                               : label_from(value, done + i);
      }
      done += values;
    }
  }

  void read_text(std::vector<std::int32_t>& labels) {
    std::string word;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (!next_word(word)) fail_short(fmt::format("{} values", i));
      std::int64_t value = 0;
      const char* end = word.data() + word.size();
      const auto [parsed, error] = std::from_chars(word.data(), end, value);
      if (error != std::errc() || parsed != end) {
        throw InputError(fmt::format("{}: value {} is '{}', which is no whole number of 64 bits",
                                     file_, i, word));
      }
      labels[i] = label_from(value, i);
    }
    if (next_word(word)) {
      throw InputError(fmt::format("{}: '{}' follows the {} values that 'sizes' asks for", file_,
                                   word, labels.size()));
    }
  }

  /// Words longer than any number are cut, which leaves them no numbers.
  bool next_word(std::string& word) {
    constexpr std::size_t longest = 40;
    const auto is_space = [](int c) {
      return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == ',';
    };
    constexpr int end = std::ifstream::traits_type::eof();
    word.clear();
    int c = input_.get();
    while (is_space(c)) c = input_.get();
    for (; c != end && !is_space(c); c = input_.get()) {
      if (word.size() < longest) word.push_back(static_cast<char>(c));
    }
    return !word.empty();
  }

  std::string file_;
  std::ifstream input_;
  NrrdHeader header_;
  std::uint64_t left_ = 0;   ///< bytes after the header
  std::uint64_t count_ = 0;  ///< voxels
};

}  // namespace

VoxelGrid<std::int32_t> read_nrrd_volume(const std::filesystem::path& file) {
  return Reader(file).read();
}

}  // namespace fracbench
