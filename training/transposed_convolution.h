#pragma once

#include <torch/types.h>

namespace fracbench::training {

/// Transposed convolution of kernel 4, stride 2, padding 1 without bias, as one convolution of
/// kernel 2 with eight times the outputs, one for each parity, whose voxels are then put in their
/// places (see neural/transposed_convolution.h). libtorch does its own transposed convolutions
/// several times slower on a processor. `input` is 1 x in x side^3, `weight` in x out x 4^3.
torch::Tensor transposed_convolution(const torch::Tensor& input, const torch::Tensor& weight);

}  // namespace fracbench::training
