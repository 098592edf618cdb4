#pragma once

#include <vector>

#include "methods/validation.h"

namespace fracbench::modes {

/// The cases that hold impacts on a prepared body to closed forms: conservation, and the break
/// test.
std::vector<ValidationCase> impact_validation_cases();

}  // namespace fracbench::modes
