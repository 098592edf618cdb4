#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/digest.h"

namespace fracbench {

/// Stored data is not what it should be: cut short, damaged, or of another kind.
class DataError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Named arrays, as a record file holds them: names are paths such as "fragments/vertices".
/// An array has rank 0 (one value), 1 or 2 (rows of equal length). Everything that goes into a file
/// goes through here, so that what is written, what is read and what is digested are the same.
class DataTree {
 public:
  enum class Type : std::uint8_t { int32, int64, uint64, float64, text };

  struct Array {
    Type type = Type::float64;
    std::size_t element_size = 8;      ///< bytes; for text that of the longest, at least 1
    std::vector<std::uint64_t> shape;  ///< empty: one value
    std::vector<std::byte> bytes;      ///< text is padded with zeros
    bool operator==(const Array&) const = default;
  };

  /// One value.
  void put(std::string_view path, double value);
  void put(std::string_view path, std::int64_t value);
  void put(std::string_view path, std::uint64_t value);
  void put(std::string_view path, std::string_view text);
  /// A list, or rows of `columns` values each where that is not 0. Text must not hold zero bytes.
  void put(std::string_view path, std::span<const double> values, std::size_t columns = 0);
  void put(std::string_view path, std::span<const std::int32_t> values, std::size_t columns = 0);
  void put(std::string_view path, std::span<const std::uint64_t> values);
  void put(std::string_view path, std::span<const std::string> texts);

  /// The getters throw DataError where the array is missing or of another type or rank.
  bool has(std::string_view path) const { return arrays_.contains(path); }
  double real(std::string_view path) const;
  std::int64_t integer(std::string_view path) const;
  std::uint64_t word(std::string_view path) const;
  std::string text(std::string_view path) const;
  std::vector<double> reals(std::string_view path, std::size_t columns = 0) const;
  std::vector<std::int32_t> integers(std::string_view path, std::size_t columns = 0) const;
  std::vector<std::uint64_t> words(std::string_view path) const;
  std::vector<std::string> texts(std::string_view path) const;

  /// SHA-256 over names, types, shapes and bytes, in the order of the names.
  std::string digest() const;

  const std::map<std::string, Array, std::less<>>& arrays() const { return arrays_; }
  void put_array(std::string path, Array array) { arrays_[std::move(path)] = std::move(array); }

  bool operator==(const DataTree&) const = default;

 private:
  std::map<std::string, Array, std::less<>> arrays_;
};

}  // namespace fracbench
