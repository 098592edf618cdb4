#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fracbench {

/// The fields of each line of a CSV text (RFC 4180; lines may also end in a bare line feed). Throws
/// InputError for an unfinished quote; `where` names the file.
std::vector<std::vector<std::string>> parse_csv(std::string_view text, std::string_view where);

}  // namespace fracbench
