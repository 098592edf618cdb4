#pragma once

#include "scenarios/families.h"

namespace fracbench {

/// The paper's scene: one ball from a uniformly random direction, aimed at the origin, its speed
/// uniformly random (section 4.1).
class SingleFamily final : public ScenarioFamily {
 public:
  FamilyInfo info() const override;
  OptionsSchema options() const override;
  std::vector<Scenario> scenes(const Options& options, std::string_view shape,
                               std::uint64_t seed) const override;
};

}  // namespace fracbench
