#pragma once

#include <cstdint>
#include <span>

#include "core/contingency.h"

namespace fracbench {

/// Agreement of two labellings of the same places (Hubert and Arabie, "Comparing partitions",
/// 1985): 1 for the same partition whatever the labels' numbers, about 0 for unrelated ones. Only
/// places count where both are >= 0; 1 where there are none. Throws std::invalid_argument for
/// labellings of different lengths.
double adjusted_rand_index(std::span<const std::int32_t> a, std::span<const std::int32_t> b);
double adjusted_rand_index(const Contingency& counts);

}  // namespace fracbench
