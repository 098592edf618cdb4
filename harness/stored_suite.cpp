#include "harness/stored_suite.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <set>

#include "core/digest.h"
#include "core/error.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kShownDifferences = 8;

std::string digest_of(const Json& values) {
  Digest digest;
  digest.add(std::string_view(values.dump()));
  return digest.hex();
}

/// "/methods/cvd/options/sites" as --set would have it, where it could.
std::string readable(std::string path) {
  path.erase(0, 1);
  for (std::size_t at = path.find('/'); at != std::string::npos; at = path.find('/', at)) {
    path[at] = '.';
  }
  return path;
}

}  // namespace

StoredSuite read_stored_suite(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "suite.json";
  std::ifstream stream(file);
  if (!stream) {
    throw InputError(
        fmt::format("{}: is no results folder (there is no suite.json in it); make one with "
                    "fracbench run SUITE --out {}",
                    folder.string(), folder.string()));
  }
  try {
    const Json json = Json::parse(stream);
    StoredSuite stored{.name = json.at("suite").at("name"),
                       .summary = json.at("summary"),
                       .values = json.at("suite"),
                       .cells = json.at("cells"),
                       .command = json.value("command", "")};
    if (json.at("digest") == digest_of(stored.values)) return stored;
  } catch (const nlohmann::json::exception&) {
  }
  throw InputError(fmt::format(
      "{}: is damaged; remove it and run the suite again: good records are kept", file.string()));
}

std::string stored_suite_text(const StoredSuite& suite) {
  const Json json{{"summary", suite.summary},
                  {"command", suite.command},
                  {"cells", suite.cells},
                  {"digest", digest_of(suite.values)},
                  {"suite", suite.values}};
  return json.dump(2) + "\n";
}

std::vector<std::string> differing_values(const StoredSuite& stored, const Json& values) {
  const Json there = stored.values.flatten();
  const Json here = values.flatten();
  std::vector<std::string> differences;
  const auto shown = [](const Json& json, const std::string& path) {
    return json.contains(path) ? json[path].dump() : std::string("absent");
  };
  std::set<std::string> paths;
  for (const auto& item : there.items()) paths.insert(item.key());
  for (const auto& item : here.items()) paths.insert(item.key());
  for (const std::string& path : paths) {
    const std::string old_value = shown(there, path);
    const std::string new_value = shown(here, path);
    if (old_value == new_value) continue;
    differences.push_back(
        fmt::format("{}: {} there, {} here", readable(path), old_value, new_value));
  }
  return differences;
}

std::string describe_other_suite(const std::filesystem::path& folder,
                                 const std::vector<std::string>& differences) {
  std::string text =
      fmt::format("{}: belongs to another suite or to other values of it:\n", folder.string());
  for (std::size_t i = 0; i < std::min(kShownDifferences, differences.size()); ++i) {
    text += fmt::format("  {}\n", differences[i]);
  }
  if (differences.size() > kShownDifferences) {
    text += fmt::format("  and {} more\n", differences.size() - kShownDifferences);
  }
  return text + "choose another folder with --out, or ask for the same values as before";
}

}  // namespace fracbench
