#pragma once

#include "methods/bem/crack_sheet.h"
#include "methods/bem/stress_field.h"
#include "methods/bem/stress_intensity.h"

namespace fracbench::bem {

/// The `fast` model (Hahn and Wojtan 2016): the stress of the uncracked body at each vertex of the
/// front, turned by driving_stress, through fast_stress_intensity with the area of its crack. No
/// crack feels another.
StressIntensityModel fast_model(StressField stress, const FastFactors& factors,
                                double compressive_factor);

}  // namespace fracbench::bem
