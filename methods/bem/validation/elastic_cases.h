#pragma once

#include <vector>

#include "methods/validation.h"

namespace fracbench::bem {

/// The cases about elastostatics without cracks: rigid modes, uniform stress, a manufactured
/// solution with its order of convergence, the thick sphere, the duration of a contact.
std::vector<ValidationCase> elastic_validation_cases();

}  // namespace fracbench::bem
