#pragma once

#include "neural/network_options.h"

namespace fracbench::neural {

/// Floating-point operations of the code-to-voxel decoder for one field, for comparison with the
/// machine's rate.
double decoding_operations(const NetworkOptions& options, int resolution);

/// How much work one step of training is, in units of its own for each kind of decoder: to compare
/// networks that differ in their resolutions alone.
double training_work(const NetworkOptions& options);

}  // namespace fracbench::neural
