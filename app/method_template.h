#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fracbench {

/// Writes a method of that name into a clone of the repository: methods/<name>/, a test and a page.
/// Nothing is overwritten. Returns the files. Throws InputError for a name that is not made of
/// lower-case letters, digits and hyphens or is taken, and where the folder is no clone.
std::vector<std::filesystem::path> write_method_template(const std::filesystem::path& repository,
                                                         const std::string& name);

/// What has to be added to methods/registry.cpp: the include, and the class.
std::vector<std::string> registry_lines(const std::string& name);

}  // namespace fracbench
