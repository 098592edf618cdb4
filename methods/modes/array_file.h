#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fracbench::modes {

/// Named lists of numbers and texts in one file:
///
///     one line of JSON: {"format": "fracbench modes", "version": 1, "texts": {name: text},
///                        "arrays": [[name, "float64" or "int32", count], ...]}
///     the arrays in that order, little endian, without gaps
///     64 hexadecimal digits: SHA-256 of all before
struct ArrayFile {
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<std::int32_t>> integers;
  std::map<std::string, std::string> texts;

  bool operator==(const ArrayFile&) const = default;
};

/// The same arrays give the same bytes; the file appears whole or not at all. Throws InputError.
void write_array_file(const std::filesystem::path& file, const ArrayFile& arrays);

/// Throws InputError, with the file's name, where it cannot be read, is of another kind or version,
/// or is damaged.
ArrayFile read_array_file(const std::filesystem::path& file);

}  // namespace fracbench::modes
