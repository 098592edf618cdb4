#pragma once

#include "scenarios/families.h"

namespace fracbench {

/// One scene, written by hand in TOML (scenario_toml.h).
class FileFamily final : public ScenarioFamily {
 public:
  FamilyInfo info() const override;
  OptionsSchema options() const override;
  std::vector<Scenario> scenes(const Options& options, std::string_view shape,
                               std::uint64_t seed) const override;
};

}  // namespace fracbench
