#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fracbench {

/// Named lists of numbers and texts, as prepared models, data sets and check points keep them.
struct ArrayFile {
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<float>> floats;
  std::map<std::string, std::vector<std::int32_t>> integers;
  std::map<std::string, std::string> texts;

  bool operator==(const ArrayFile&) const = default;
};

/// The same of numbers that lie elsewhere and stay there, to be written without a copy.
struct ArrayViews {
  ArrayViews() = default;
  ArrayViews(const ArrayFile& arrays);

  std::map<std::string, std::span<const double>> reals;
  std::map<std::string, std::span<const float>> floats;
  std::map<std::string, std::span<const std::int32_t>> integers;
  std::map<std::string, std::string> texts;
};

/// What a file is, as its first line says.
struct ArrayFileKind {
  std::string_view format;  ///< "fracbench modes"
  int version = 1;
  bool packed = false;  ///< arrays are written with their bytes shuffled and deflated
};

/// Writes one self-describing file:
///
///     one line of JSON: {"format": ..., "version": ..., "texts": {name: text},
///                        "arrays": [[name, "float64", "float32" or "int32", count], ...]}
///     the arrays in that order, little endian, without gaps
///     64 hexadecimal digits: SHA-256 of all before, and of its length ahead of it (core/digest.h)
///
/// A packed array has the number of its bytes in the file as fifth entry; unpacked (zlib), they
/// hold the first bytes of all its numbers, then the second ones, and so on. The same arrays give
/// the same bytes; the file appears whole or not at all. Throws InputError.
void write_array_file(const std::filesystem::path& file, const ArrayViews& arrays,
                      const ArrayFileKind& kind);

/// Reads such a file, packed or not. Sizes are checked against that of the file before memory is
/// taken, and nothing in it is ever run. Throws InputError, with the file's name, where it cannot
/// be read, is of another kind or version, or is damaged.
ArrayFile read_array_file(const std::filesystem::path& file, const ArrayFileKind& kind);

}  // namespace fracbench
