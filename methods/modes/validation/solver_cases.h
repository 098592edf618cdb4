#pragma once

#include <vector>

#include "methods/validation.h"

namespace fracbench::modes {

/// The cases that hold the modes, before any impact, to closed forms, to the published reference
/// table and to what must not change them; cheapest first.
std::vector<ValidationCase> solver_validation_cases();

}  // namespace fracbench::modes
