#pragma once

#include <span>
#include <vector>

#include "neural/network_options.h"
#include "neural/volume.h"

namespace fracbench::neural {

/// A transposed convolution of kernel 4, stride 2 and padding 1 over a cube, as matrix products.
///
/// Along one axis, output 2 j takes the inputs j - 1 and j by the taps 3 and 1, output 2 j - 1
/// takes them by the taps 2 and 0. So every window of 2^3 inputs, the cube padded with a layer of
/// zeros, gives one value of each of the eight outputs around it, and all of it is one product of
/// (8 outputs) x (8 inputs) with (8 inputs) x ((side + 1)^3 windows): no multiplication by a zero
/// that is not in the padding.
class TransposedConvolution {
 public:
  /// `weight` is [in][out][4][4][4] as libtorch keeps it, z first; `bias` has `out` values or none.
  TransposedConvolution(const DecoderLayer& layer, std::span<const float> weight,
                        std::span<const float> bias);

  /// `input` is [in][side^3], x fastest; the result [out][(2 side)^3], the same for any number of
  /// threads. They are those of BLAS, whose number is a setting of the process.
  Volume operator()(std::span<const float> input, int threads) const;

 private:
  Volume many_outputs(std::span<const float> input, int threads) const;
  Volume one_output(std::span<const float> input, int threads) const;

  DecoderLayer layer_;
  std::vector<float> matrix_;
  std::vector<float> bias_;
};

}  // namespace fracbench::neural
