#include "harness/suite_files.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cstdlib>
#include <map>

#include "core/error.h"
#include "core/text.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

std::string read_summary(const fs::path& file) {
  try {
    return toml::parse_file(file.string())["summary"].value_or(std::string());
  } catch (const toml::parse_error&) {
    return "";
  }
}

}  // namespace

std::vector<fs::path> suite_folders() {
  std::vector<fs::path> folders;
  if (const char* list = std::getenv("FRACBENCH_SUITES")) {
    std::string_view rest = list;
    while (!rest.empty()) {
      const std::size_t colon = std::min(rest.find(':'), rest.size());
      if (colon > 0) folders.emplace_back(rest.substr(0, colon));
      rest.remove_prefix(std::min(colon + 1, rest.size()));
    }
  }
  folders.emplace_back(FRACBENCH_SUITE_FOLDER);
  return folders;
}

std::vector<SuiteFile> list_suites() {
  std::map<std::string, SuiteFile> suites;
  for (const fs::path& folder : suite_folders()) {
    std::error_code error;
    for (const auto& item : fs::directory_iterator(folder, error)) {
      if (item.path().extension() != ".toml") continue;
      const std::string name = item.path().stem().string();
      if (!suites.contains(name)) suites[name] = {name, read_summary(item.path()), item.path()};
    }
  }
  std::vector<SuiteFile> list;
  for (auto& [name, suite] : suites) list.push_back(std::move(suite));
  return list;
}

fs::path find_suite_file(std::string_view name) {
  if (name.ends_with(".toml")) {
    if (fs::is_regular_file(name)) return name;
    throw InputError(fmt::format("{}: there is no such suite file", name));
  }
  std::vector<std::string> names;
  for (const SuiteFile& suite : list_suites()) {
    if (suite.name == name) return suite.file;
    names.push_back(suite.name);
  }
  throw InputError(fmt::format("unknown suite '{}'{} (or give the path of a .toml file)", name,
                               did_you_mean(name, names)));
}

}  // namespace fracbench
