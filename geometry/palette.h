#pragma once

#include <cstddef>

#include "core/vec3.h"

namespace fracbench {

/// Colour of fragment `index`, sRGB in [0, 1]: the seven hues of Okabe and Ito ("Color Universal
/// Design", 2008), which people with any kind of colour vision tell apart, then lighter and darker
/// tones of them.
Vec3 fragment_color(std::size_t index);

/// Of fracture surface: a light, warm grey that stands out from all of them.
Vec3 fracture_color();

/// The light that an sRGB colour stands for, as renderers want it (IEC 61966-2-1).
Vec3 linear_color(const Vec3& srgb);

}  // namespace fracbench
