#pragma once

#include <vector>

#include "methods/validation.h"

namespace fracbench::bem {

/// How the whole method behaves where there is no closed form: strength of the impact, distance
/// from it, resolution, orientation. On a box and a handful of impacts at a coarse scale.
std::vector<ValidationCase> behaviour_cases();

}  // namespace fracbench::bem
