#pragma once

#include "scenarios/families.h"

namespace fracbench {

/// Collision conditions read from a CSV file with the columns shape, id, px, py, pz, vx, vy, vz:
/// place and velocity of one ball a row. A row is for every target whose name agrees with the row's
/// shape up to the first '_'.
class PublishedFamily final : public ScenarioFamily {
 public:
  FamilyInfo info() const override;
  OptionsSchema options() const override;
  std::vector<Scenario> scenes(const Options& options, std::string_view shape,
                               std::uint64_t seed) const override;
};

}  // namespace fracbench
