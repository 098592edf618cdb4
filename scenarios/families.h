#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "core/options.h"
#include "scenarios/scenario.h"

namespace fracbench {

struct FamilyInfo {
  std::string name;
  std::string summary;
};

/// A family of scenes, such as "one ball from a random direction". Stateless; adding one is a file
/// pair below families/ and a line in families.cpp.
class ScenarioFamily {
 public:
  virtual ~ScenarioFamily() = default;
  virtual FamilyInfo info() const = 0;
  virtual OptionsSchema options() const = 0;

  /// The scenes, from options and seed alone. Scene k does not depend on how many there are, so
  /// that a longer run contains the shorter one. `shape` is the target's name, for families whose
  /// scenes differ by shape (published collision conditions).
  virtual std::vector<Scenario> scenes(const Options& options, std::string_view shape,
                                       std::uint64_t seed) const = 0;
};

/// All families that are built in, in the order of the documentation.
const std::vector<std::unique_ptr<ScenarioFamily>>& scenario_families();

/// The family of this name. Throws InputError, naming the nearest one.
const ScenarioFamily& find_family(std::string_view name);

}  // namespace fracbench
