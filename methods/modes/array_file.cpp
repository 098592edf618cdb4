#include "methods/modes/array_file.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/atomic_file.h"
#include "core/digest.h"
#include "core/error.h"

static_assert(std::endian::native == std::endian::little, "array files are little endian");

namespace fracbench::modes {
namespace {

constexpr std::string_view kFormat = "fracbench modes";
constexpr int kVersion = 1;
constexpr std::size_t kDigestLength = 64;

std::string digest_of(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.hex();
}

template <typename T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <typename T>
std::vector<T> take(std::string_view& bytes, std::size_t count) {
  if (bytes.size() / sizeof(T) < count) throw InputError("its arrays are longer than the file");
  std::vector<T> values(count);
  if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
  return values;
}

ArrayFile parse(std::string_view bytes) {
  if (bytes.size() < kDigestLength || digest_of(bytes.substr(0, bytes.size() - kDigestLength)) !=
                                          bytes.substr(bytes.size() - kDigestLength)) {
    throw InputError("it is damaged or cut short: its check sum does not fit");
  }
  bytes.remove_suffix(kDigestLength);
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos) throw InputError("it has no header line");
  const auto header = nlohmann::json::parse(bytes.substr(0, end));
  bytes.remove_prefix(end + 1);
  if (header.at("format") != kFormat) throw InputError("it is of another kind");
  if (header.at("version") != kVersion) {
    throw InputError(fmt::format("it has version {}, this program reads version {}",
                                 header.at("version").dump(), kVersion));
  }
  ArrayFile arrays;
  arrays.texts = header.at("texts").get<std::map<std::string, std::string>>();
  for (const auto& entry : header.at("arrays")) {
    const auto name = entry.at(0).get<std::string>(), type = entry.at(1).get<std::string>();
    const auto count = entry.at(2).get<std::size_t>();
    if (type == "float64") {
      arrays.reals[name] = take<double>(bytes, count);
    } else {
      arrays.integers[name] = take<std::int32_t>(bytes, count);
    }
  }
  return arrays;
}

}  // namespace

void write_array_file(const std::filesystem::path& file, const ArrayFile& arrays) {
  nlohmann::ordered_json header;
  header["format"] = kFormat;
  header["version"] = kVersion;
  header["texts"] = arrays.texts;
  header["arrays"] = nlohmann::ordered_json::array();
  for (const auto& [name, values] : arrays.reals) {
    header["arrays"].push_back({name, "float64", values.size()});
  }
  for (const auto& [name, values] : arrays.integers) {
    header["arrays"].push_back({name, "int32", values.size()});
  }
  std::string bytes = header.dump() + "\n";
  for (const auto& [name, values] : arrays.reals) append(bytes, values);
  for (const auto& [name, values] : arrays.integers) append(bytes, values);
  bytes += digest_of(bytes);
  write_file_atomically(file, bytes);
}

ArrayFile read_array_file(const std::filesystem::path& file) {
  const auto fail = [&](std::string_view why) {
    throw InputError(fmt::format("modes: cannot read the prepared model '{}': {}; prepare it again",
                                 file.string(), why));
  };
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail("the file is not there or cannot be opened");
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  ArrayFile arrays;
  try {
    arrays = parse(bytes);
  } catch (const InputError& error) {
    fail(error.what());
  } catch (const nlohmann::json::exception& error) {
    fail(error.what());
  }
  return arrays;
}

}  // namespace fracbench::modes
