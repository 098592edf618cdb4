#include "scenarios/families/file.h"

#include "core/error.h"
#include "scenarios/scenario_toml.h"

namespace fracbench {

FamilyInfo FileFamily::info() const {
  return {.name = "file", .summary = "one scene, written by hand in a TOML file"};
}

OptionsSchema FileFamily::options() const {
  return {{.name = "path",
           .fallback = std::string(),
           .unit = "",
           .summary = "TOML file of the scene (see docs/scenarios.md)"}};
}

std::vector<Scenario> FileFamily::scenes(const Options& options, std::string_view,
                                         std::uint64_t) const {
  if (options.text("path").empty()) {
    throw InputError("scenario family 'file': option 'path' is not given; name a TOML file");
  }
  return {read_scenario(options.text("path"))};
}

}  // namespace fracbench
