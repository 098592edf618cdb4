#pragma once

#include <torch/types.h>

namespace fracbench::training {

/// leaky_relu(scale (volume - mean) / sqrt(variance + epsilon) + shift) with the mean and the
/// variance of each channel over the voxels of this very volume: batch normalisation of a batch of
/// one. `volume` is 1 x channels x side^3, `scale` and `shift` have a value for each channel.
torch::Tensor normalised_activation(const torch::Tensor& volume, const torch::Tensor& scale,
                                    const torch::Tensor& shift, double epsilon, double slope);

}  // namespace fracbench::training
