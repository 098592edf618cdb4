#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "harness/catalog.h"
#include "harness/suite.h"

namespace fracbench {

/// Reads a suite from TOML text (docs/suites.md has the format). `source` is the file that messages
/// name; mesh files are looked for relative to its folder, and the suite is called after it unless
/// it gives itself a name. Throws InputError with file and line: for a mistake in the syntax, an
/// unknown key (with the nearest valid one), a value of the wrong type or out of range.
Suite parse_suite(std::string_view text, const std::filesystem::path& source,
                  const Catalog& catalog);

/// The same from a file. Throws InputError also where it cannot be read.
Suite read_suite(const std::filesystem::path& file, const Catalog& catalog);

}  // namespace fracbench
