#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace fracbench {

/// What suite.json says of the suite that a results folder belongs to.
struct StoredSuite {
  std::string name;
  std::string summary;
  nlohmann::ordered_json values;  ///< see to_json(Suite)
  std::size_t cells = 0;          ///< of the whole suite
  std::string command = {};       ///< that measures it; empty where that was not kept
};

/// Throws InputError where the folder is no results folder or the file is damaged.
StoredSuite read_stored_suite(const std::filesystem::path& folder);

/// The text of suite.json.
std::string stored_suite_text(const StoredSuite& suite);

/// "seed: 1 there, 7 here" for each value that is not the same.
std::vector<std::string> differing_values(const StoredSuite& stored,
                                          const nlohmann::ordered_json& values);

/// The message for a folder that belongs to another suite.
std::string describe_other_suite(const std::filesystem::path& folder,
                                 const std::vector<std::string>& differences);

}  // namespace fracbench
