#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fracbench {

struct SuiteFile {
  std::string name;     ///< the file's stem
  std::string summary;  ///< what the file says of itself; empty where it cannot be read
  std::filesystem::path file;
};

/// The folders in which suites are looked for by name: those of the environment variable
/// FRACBENCH_SUITES (separated by colons), then the one that comes with the program.
std::vector<std::filesystem::path> suite_folders();

/// All suites in those folders, by name; of two with the same name the first one.
std::vector<SuiteFile> list_suites();

/// The file of a suite: `name` is a path that ends in .toml, or the name of one from
/// list_suites(). Throws InputError, with the nearest name.
std::filesystem::path find_suite_file(std::string_view name);

}  // namespace fracbench
