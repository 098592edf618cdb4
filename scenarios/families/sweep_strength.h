#pragma once

#include "scenarios/families.h"

namespace fracbench {

/// Balls of rising speed in one direction (section 3 of the supplement).
class SweepStrengthFamily final : public ScenarioFamily {
 public:
  FamilyInfo info() const override;
  OptionsSchema options() const override;
  std::vector<Scenario> scenes(const Options& options, std::string_view shape,
                               std::uint64_t seed) const override;
};

}  // namespace fracbench
