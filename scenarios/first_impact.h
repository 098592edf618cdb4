#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/context.h"
#include "core/impact.h"
#include "core/target.h"
#include "scenarios/scenario.h"

namespace fracbench {

struct FirstImpact {
  Impact impact;
  bool breaks = false;  ///< by the scenario's break test
};

/// What happens to the target in the scene up to its first break: the impact that breaks it or,
/// where none does, the strongest one; nothing where no ball hits it. Needs no fracture method and
/// takes milliseconds.
std::optional<FirstImpact> find_first_impact(const Scenario& scenario, const Target& target,
                                             Context& context);

/// The same for many scenes of one target, which is prepared only once.
std::vector<std::optional<FirstImpact>> find_first_impacts(std::span<const Scenario> scenarios,
                                                           const Target& target, Context& context);

}  // namespace fracbench
