#pragma once

#include "scenarios/families.h"

namespace fracbench {

/// Two balls at random places, flying at random speeds at random points near the origin (section 2
/// of the supplement, which states no more than that).
class DualFamily final : public ScenarioFamily {
 public:
  FamilyInfo info() const override;
  OptionsSchema options() const override;
  std::vector<Scenario> scenes(const Options& options, std::string_view shape,
                               std::uint64_t seed) const override;
};

}  // namespace fracbench
