#pragma once

#include "neural/data_set.h"

namespace fracbench::test {

/// A ball of radius 0.8 m, cut in three by two parallel planes whose direction and place follow
/// from the impulse, as a GS-SDF at these resolutions.
neural::DataSet made_up_data(int patterns, const std::vector<int>& resolutions, int features = 1);

}  // namespace fracbench::test
