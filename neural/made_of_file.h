#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/array_file.h"
#include "core/error.h"

namespace fracbench::neural {

/// What `make` makes of the arrays in a file. Throws InputError, with the file's name, for what
/// `make` refuses (InputError, nlohmann::json::exception), too.
template <typename Make>
auto made_of_file(const std::filesystem::path& file, const ArrayFileKind& kind, const Make& make) {
  ArrayFile arrays = read_array_file(file, kind);
  const auto refusal = [&](const std::exception& error) {
    return InputError(fmt::format("cannot read '{}': {}", file.string(), error.what()));
  };
  try {
    return make(arrays);
  } catch (const nlohmann::json::exception& error) {
    throw refusal(error);
  } catch (const InputError& error) {
    throw refusal(error);
  }
}

}  // namespace fracbench::neural
