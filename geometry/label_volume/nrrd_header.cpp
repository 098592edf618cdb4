#include "geometry/label_volume/nrrd_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "core/error.h"
#include "geometry/label_volume/checked_grid.h"

namespace fracbench {
namespace {

constexpr std::size_t longest_line = 1 << 16;
constexpr int most_lines = 10000;

struct IntegerType {
  int bytes;
  bool is_signed;
};

/// The format has several names for each type.
std::optional<IntegerType> integer_type(std::string_view name) {
  static const std::map<std::string_view, IntegerType> types = {
      {"signed char", {1, true}},
      {"int8", {1, true}},
      {"int8_t", {1, true}},
      {"uchar", {1, false}},
      {"unsigned char", {1, false}},
      {"uint8", {1, false}},
      {"uint8_t", {1, false}},
      {"short", {2, true}},
      {"short int", {2, true}},
      {"signed short", {2, true}},
      {"signed short int", {2, true}},
      {"int16", {2, true}},
      {"int16_t", {2, true}},
      {"ushort", {2, false}},
      {"unsigned short", {2, false}},
      {"unsigned short int", {2, false}},
      {"uint16", {2, false}},
      {"uint16_t", {2, false}},
      {"int", {4, true}},
      {"signed int", {4, true}},
      {"int32", {4, true}},
      {"int32_t", {4, true}},
      {"uint", {4, false}},
      {"unsigned int", {4, false}},
      {"uint32", {4, false}},
      {"uint32_t", {4, false}},
      {"longlong", {8, true}},
      {"long long", {8, true}},
      {"long long int", {8, true}},
      {"signed long long", {8, true}},
      {"signed long long int", {8, true}},
      {"int64", {8, true}},
      {"int64_t", {8, true}},
      {"ulonglong", {8, false}},
      {"unsigned long long", {8, false}},
      {"unsigned long long int", {8, false}},
      {"uint64", {8, false}},
      {"uint64_t", {8, false}},
  };
  const auto found = types.find(name);
  if (found == types.end()) return std::nullopt;
  return found->second;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!(text = trimmed(text)).empty()) {
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return words;
}

template <typename T>
std::optional<T> number(std::string_view word) {
  T value{};
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// The fields of a header by their names in lower case, and how they are understood.
class Fields {
 public:
  Fields(std::istream& input, std::string_view file) : file_(file) {
    std::string line = next_line(input);
    if (line.size() != 8 || !line.starts_with("NRRD000") || line[7] < '1' || line[7] > '5') {
      throw InputError(fmt::format("{}: starts with '{}'; NRRD0001 to NRRD0005 are supported",
                                   file_, line.substr(0, 40)));
    }
    for (int count = 0; !(line = next_line(input)).empty(); ++count) {
      if (count == most_lines) fail("header", "longer than 10000 lines", "it is damaged");
      if (line[0] == '#') continue;
      const std::size_t colon = line.find(':');
      if (colon == std::string::npos) {
        throw InputError(
            fmt::format("{}: header line '{}' is no 'field: value'", file_, line.substr(0, 80)));
      }
      if (colon + 1 < line.size() && line[colon + 1] == '=') continue;  // a key of somebody's own
      const std::string name = lower_case(trimmed(std::string_view(line).substr(0, colon)));
      const std::string_view value = trimmed(std::string_view(line).substr(colon + 1));
      if (!values_.emplace(name, value).second) fail(name, std::string(value), "it is there twice");
    }
  }

  NrrdHeader header() const {
    NrrdHeader header;
    refuse_what_is_not_supported();
    const auto type = integer_type(lower_case(needed("type")));
    if (!type) {
      fail("type", needed("type"), "labels are integers of 8 to 64 bits, e.g. int32: convert them");
    }
    header.bytes = type->bytes;
    header.is_signed = type->is_signed;
    header.encoding = encoding();
    if (header.encoding != NrrdHeader::Encoding::text && header.bytes > 1) {
      const std::string endian = lower_case(needed("endian"));
      if (endian != "little" && endian != "big") fail("endian", endian, "it is little or big");
      header.is_big_endian = endian == "big";
    }
    if (needed("dimension") != "3") {
      fail("dimension", needed("dimension"), "a volume of labels has 3 dimensions");
    }
    const auto sizes = words_of(needed("sizes"));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto size = axis < sizes.size() ? number<std::uint64_t>(sizes[axis]) : std::nullopt;
      if (!size || sizes.size() != 3) fail("sizes", needed("sizes"), "3 whole numbers are needed");
      header.sizes[axis] = *size;
    }
    check_kinds();
    read_place(header);
    return header;
  }

 private:
  [[noreturn]] void fail(std::string_view field, std::string_view value,
                         std::string_view way_out) const {
    throw InputError(
        fmt::format("{}: field '{}' is '{}': {}", file_, field, value.substr(0, 200), way_out));
  }

  std::string next_line(std::istream& input) const {
    std::string line;
    for (int c = input.get(); c != '\n'; c = input.get()) {
      if (c == std::istream::traits_type::eof()) {
        throw InputError(fmt::format(
            "{}: the header ends within the file's last line; it is cut short (an empty line ends "
            "the header, the data follow)",
            file_));
      }
      line.push_back(static_cast<char>(c));
      if (line.size() > longest_line) fail("header", line, "the line is too long: it is damaged");
    }
    if (line.ends_with('\r')) line.pop_back();
    return line;
  }

  const std::string* find(std::string_view name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? nullptr : &found->second;
  }
  const std::string& needed(std::string_view name) const {
    const std::string* value = find(name);
    if (value == nullptr) {
      throw InputError(fmt::format("{}: the header has no field '{}'", file_, name));
    }
    return *value;
  }

  void refuse_what_is_not_supported() const {
    const auto refuse = [&](std::string_view name, std::string_view allowed,
                            std::string_view way_out) {
      const std::string* value = find(name);
      if (value != nullptr && *value != allowed) fail(name, *value, way_out);
    };
    for (const char* name : {"data file", "datafile"}) {
      refuse(name, {}, "detached data are not supported: write header and data to one file");
    }
    for (const char* name : {"line skip", "lineskip", "byte skip", "byteskip"}) {
      refuse(name, "0", "skipping is not supported: write the data right after the header");
    }
    refuse("space dimension", "3", "it must be 3");
  }

  NrrdHeader::Encoding encoding() const {
    const std::string name = lower_case(needed("encoding"));
    if (name == "raw") return NrrdHeader::Encoding::raw;
    if (name == "gzip" || name == "gz") return NrrdHeader::Encoding::gzip;
    if (name == "ascii" || name == "text" || name == "txt") return NrrdHeader::Encoding::text;
    fail("encoding", name, "supported are raw, gzip and ascii: write it as one of these");
  }

  void check_kinds() const {
    const std::string* kinds = find("kinds");
    if (kinds == nullptr) return;
    for (const std::string_view kind : words_of(*kinds)) {
      const std::string name = lower_case(kind);
      if (name != "domain" && name != "space" && name != "none" && name != "???") {
        fail("kinds", *kinds, "all three axes must be of kind 'domain' or 'space'");
      }
    }
  }

  /// From 'space origin' and 'space directions', else from 'axis mins', 'spacings' and 'centers'.
  void read_place(NrrdHeader& header) const {
    const std::string* directions = find("space directions");
    if (directions != nullptr) {
      const std::vector<double> d = numbers("space directions", 9, true);
      for (int axis = 0; axis < 3; ++axis) {
        for (int other = 0; other < 3; ++other) {
          const double entry = d[3 * axis + other];
          if (axis == other ? entry <= 0 : entry != 0) {
            fail("space directions", *directions,
                 "the axes must point along x, y and z, in this order: resample or reorder it");
          }
        }
      }
      header.spacing = checked_spacing({d[0], d[4], d[8]}, "field 'space directions'", file_);
      const std::vector<double> origin = numbers("space origin", 3, true);
      header.origin = {origin[0], origin[1], origin[2]};
      return;
    }
    if (find("spacings") == nullptr || find("axis mins") == nullptr) {
      throw InputError(fmt::format(
          "{}: the header does not say where the voxels are: give 'space origin' and 'space "
          "directions', or 'axis mins', 'spacings' and 'centers'",
          file_));
    }
    const std::vector<double> spacings = numbers("spacings", 3, false);
    header.spacing =
        checked_spacing({spacings[0], spacings[1], spacings[2]}, "field 'spacings'", file_);
    const std::vector<double> mins = numbers("axis mins", 3, false);
    const std::string* centerings = find("centerings");  // the older name
    const std::string& centers = centerings != nullptr ? *centerings : needed("centers");
    const auto words = words_of(centers);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string center = axis < words.size() ? lower_case(words[axis]) : "";
      if (words.size() != 3 || (center != "cell" && center != "node")) {
        fail("centers", centers, "three words, 'cell' or 'node', are needed to place the voxels");
      }
      header.origin[static_cast<int>(axis)] =
          mins[axis] + (center == "cell" ? header.spacing / 2 : 0);
    }
  }

  /// Finite numbers; `are_vectors` allows the brackets and commas of vectors.
  std::vector<double> numbers(std::string_view name, std::size_t count, bool are_vectors) const {
    const std::string& text = needed(name);
    std::string plain = text;
    if (are_vectors) {
      std::replace_if(
          plain.begin(), plain.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
    }
    std::vector<double> values;
    for (const std::string_view word : words_of(plain)) {
      const auto value = number<double>(word);
      if (!value || !std::isfinite(*value)) fail(name, text, "it must hold finite numbers");
      values.push_back(*value);
    }
    if (values.size() != count) {
      fail(name, text, fmt::format("it must hold {} numbers", count));
    }
    return values;
  }

  std::string file_;
  std::map<std::string, std::string, std::less<>> values_;
};

}  // namespace

NrrdHeader read_nrrd_header(std::istream& input, std::string_view file) {
  return Fields(input, file).header();
}

}  // namespace fracbench
