#pragma once

#include <span>

#include "neural/network_options.h"

namespace fracbench::neural {

/// Of the normalisation of one layer, a value for each channel.
struct NormalisationWeights {
  std::span<const float> scale, shift;
};

void leaky_relu(std::span<float> values, float slope);

/// Normalises each channel, or each of eight groups of channels, of a volume over its voxels, by
/// its own mean and variance, then applies the leaky ReLU; in place.
void normalise(std::span<float> volume, const NormalisationWeights& weights,
               const NetworkOptions& network, int threads);

}  // namespace fracbench::neural
