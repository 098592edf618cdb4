#pragma once

#include "scenarios/families.h"

namespace fracbench {

/// Blows across a bar near its middle (section 5 of the supplement): two balls from opposite sides,
/// a little apart along the bar, shear it between them; or a single one.
class NearShearFamily final : public ScenarioFamily {
 public:
  FamilyInfo info() const override;
  OptionsSchema options() const override;
  std::vector<Scenario> scenes(const Options& options, std::string_view shape,
                               std::uint64_t seed) const override;
};

}  // namespace fracbench
