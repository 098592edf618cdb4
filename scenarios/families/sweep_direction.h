#pragma once

#include "scenarios/families.h"

namespace fracbench {

/// Balls of one speed that hit one point from directions that turn about an axis (section 4 of the
/// supplement).
class SweepDirectionFamily final : public ScenarioFamily {
 public:
  FamilyInfo info() const override;
  OptionsSchema options() const override;
  std::vector<Scenario> scenes(const Options& options, std::string_view shape,
                               std::uint64_t seed) const override;
};

}  // namespace fracbench
