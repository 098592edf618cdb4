#pragma once

#include "scenarios/families.h"

namespace fracbench {

/// The impulses of collisions whose fragments some tool has made (core/collision_folder.h).
class ImportedFamily final : public ScenarioFamily {
 public:
  FamilyInfo info() const override;
  OptionsSchema options() const override;
  std::vector<Scenario> scenes(const Options& options, std::string_view shape,
                               std::uint64_t seed) const override;
};

}  // namespace fracbench
