#pragma once

#include <vector>

#include "methods/validation.h"

namespace fracbench::bem {

/// Cracks against closed forms and published results: penny cracks in an infinite body, edge cracks
/// in strips, half-penny surface cracks, and the bias of the `fast` formula.
std::vector<ValidationCase> crack_validation_cases();

}  // namespace fracbench::bem
