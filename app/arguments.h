#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/options.h"

namespace fracbench {

/// The numbers of a comma-separated list. Throws InputError that names the argument where there
/// are not `count` of them or one is not a finite number; `form` shows what is expected.
std::vector<double> parse_numbers(std::string_view text, std::size_t count,
                                  std::string_view argument, std::string_view form);

/// Options given as --set name=value, checked against the schema. Throws InputError.
Options parse_settings(const OptionsSchema& schema, const std::vector<std::string>& settings,
                       std::string_view where);

}  // namespace fracbench
