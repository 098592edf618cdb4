#include "core/array_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <cstring>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/digest.h"
#include "core/error.h"

static_assert(std::endian::native == std::endian::little, "array files are little endian");

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kDigestLength = 64;
// Deflate cannot pack more bytes than these into one.
constexpr std::size_t kMostPacked = 1032;
// More gains little on fields of distances, and takes several times as long.
constexpr int kPackingLevel = 1;

template <typename T>
constexpr std::string_view kTypeName = "";
template <>
constexpr std::string_view kTypeName<double> = "float64";
template <>
constexpr std::string_view kTypeName<float> = "float32";
template <>
constexpr std::string_view kTypeName<std::int32_t> = "int32";

std::string digest_of(std::span<const std::string_view> parts) {
  Digest digest;
  digest.add(parts);
  return digest.hex();
}

template <typename T>
std::string_view bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// The first bytes of all numbers of `width` bytes, then the second ones, and so on.
std::string shuffled(std::string_view bytes, std::size_t width) {
  const std::size_t count = bytes.size() / width;
  std::string out(bytes.size(), '\0');
  for (std::size_t b = 0; b < width; ++b) {
    for (std::size_t k = 0; k < count; ++k) out[b * count + k] = bytes[k * width + b];
  }
  return out;
}

std::string packed(std::string_view bytes, std::size_t width) {
  const std::string plain = shuffled(bytes, width);
  uLongf length = compressBound(plain.size());
  std::string out(length, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &length,
                reinterpret_cast<const Bytef*>(plain.data()), plain.size(),
                kPackingLevel) != Z_OK) {
    throw std::bad_alloc();
  }
  out.resize(length);
  return out;
}

/// What a file has between its first line and its check sum.
struct Body {
  Json list = Json::array();  ///< of its arrays, as the first line has it
  std::vector<std::string_view> parts;
  std::deque<std::string> packed;  ///< those of the parts that lie nowhere else
};

template <typename T>
void append(const std::map<std::string, std::span<const T>>& arrays, bool pack, Body& body) {
  for (const auto& [name, values] : arrays) {
    Json entry = {name, kTypeName<T>, values.size()};
    body.parts.push_back(bytes_of(values));
    if (pack) {
      body.parts.back() = body.packed.emplace_back(packed(body.parts.back(), sizeof(T)));
      entry.push_back(body.parts.back().size());
    }
    body.list.push_back(std::move(entry));
  }
}

template <typename T>
std::vector<T> unpacked(std::string_view bytes, std::size_t count) {
  if (bytes.size() * kMostPacked / sizeof(T) < count) {
    throw InputError("an array claims to hold more than its bytes can");
  }
  std::string plain(count * sizeof(T), '\0');
  uLongf length = plain.size();
  if (uncompress(reinterpret_cast<Bytef*>(plain.data()), &length,
                 reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) != Z_OK ||
      length != plain.size()) {
    throw InputError("an array is damaged");
  }
  std::vector<T> values(count);
  auto* out = reinterpret_cast<char*>(values.data());
  for (std::size_t b = 0; b < sizeof(T); ++b) {
    for (std::size_t k = 0; k < count; ++k) out[k * sizeof(T) + b] = plain[b * count + k];
  }
  return values;
}

/// Takes the array of a header's entry from the front of `bytes`.
template <typename T>
std::vector<T> take(std::string_view& bytes, const Json& entry) {
  const auto count = entry.at(2).get<std::size_t>();
  if (count > SIZE_MAX / sizeof(T)) throw InputError("its arrays are longer than the file");
  const bool is_packed = entry.size() > 3;
  const std::size_t stored = is_packed ? entry[3].get<std::size_t>() : count * sizeof(T);
  if (bytes.size() < stored) throw InputError("its arrays are longer than the file");
  const std::string_view mine = bytes.substr(0, stored);
  bytes.remove_prefix(stored);
  if (is_packed) return unpacked<T>(mine, count);
  std::vector<T> values(count);
  if (count > 0) std::memcpy(values.data(), mine.data(), stored);
  return values;
}

ArrayFile parse(std::string_view bytes, const ArrayFileKind& kind) {
  const bool is_long = bytes.size() >= kDigestLength;
  const std::string_view before = bytes.substr(0, is_long ? bytes.size() - kDigestLength : 0);
  if (!is_long || digest_of({&before, 1}) != bytes.substr(before.size())) {
    throw InputError("it is damaged or cut short: its check sum does not fit");
  }
  bytes.remove_suffix(kDigestLength);
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos) throw InputError("it has no header line");
  const Json header = Json::parse(bytes.substr(0, end));
  bytes.remove_prefix(end + 1);
  if (header.at("format") != kind.format) {
    throw InputError(fmt::format("it is of another kind ({}, not '{}')", header.at("format").dump(),
                                 kind.format));
  }
  if (header.at("version") != kind.version) {
    throw InputError(fmt::format("it has version {}, this program reads version {}",
                                 header.at("version").dump(), kind.version));
  }
  ArrayFile arrays;
  arrays.texts = header.at("texts").get<std::map<std::string, std::string>>();
  for (const Json& entry : header.at("arrays")) {
    const auto name = entry.at(0).get<std::string>(), type = entry.at(1).get<std::string>();
    if (type == kTypeName<double>) {
      arrays.reals[name] = take<double>(bytes, entry);
    } else if (type == kTypeName<float>) {
      arrays.floats[name] = take<float>(bytes, entry);
    } else if (type == kTypeName<std::int32_t>) {
      arrays.integers[name] = take<std::int32_t>(bytes, entry);
    } else {
      throw InputError(fmt::format("an array has the unknown type '{}'", type));
    }
  }
  return arrays;
}

/// The whole file; nothing where it cannot be read.
bool read_bytes(const std::filesystem::path& file, std::string& bytes) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) return false;
  const auto size = static_cast<std::streamoff>(stream.tellg());
  if (size < 0) return false;
  bytes.resize(static_cast<std::size_t>(size));
  stream.seekg(0);
  stream.read(bytes.data(), size);
  return static_cast<bool>(stream);
}

}  // namespace

ArrayViews::ArrayViews(const ArrayFile& arrays) : texts(arrays.texts) {
  reals.insert(arrays.reals.begin(), arrays.reals.end());
  floats.insert(arrays.floats.begin(), arrays.floats.end());
  integers.insert(arrays.integers.begin(), arrays.integers.end());
}

void write_array_file(const std::filesystem::path& file, const ArrayViews& arrays,
                      const ArrayFileKind& kind) {
  Json header;
  header["format"] = kind.format;
  header["version"] = kind.version;
  header["texts"] = arrays.texts;
  Body body;
  append(arrays.reals, kind.packed, body);
  append(arrays.floats, kind.packed, body);
  append(arrays.integers, kind.packed, body);
  header["arrays"] = std::move(body.list);
  const std::string first_line = header.dump() + "\n";
  body.parts.insert(body.parts.begin(), first_line);
  const std::string digest = digest_of(body.parts);
  body.parts.push_back(digest);
  write_file_atomically(file, body.parts);
}

ArrayFile read_array_file(const std::filesystem::path& file, const ArrayFileKind& kind) {
  const auto fail = [&](std::string_view why) -> ArrayFile {
    throw InputError(fmt::format("cannot read '{}': {}", file.string(), why));
  };
  std::string bytes;
  if (!read_bytes(file, bytes)) return fail("the file is not there or cannot be opened");
  try {
    return parse(bytes, kind);
  } catch (const InputError& error) {
    return fail(error.what());
  } catch (const nlohmann::json::exception& error) {
    return fail(error.what());
  }
}

}  // namespace fracbench
