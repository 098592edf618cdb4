#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/voxel_grid.h"
#include "neural/model.h"
#include "neural/transposed_convolution.h"

namespace fracbench::neural {

/// The code-to-voxel decoder G of a trained model, arranged for prediction: no gradients, matrix
/// products only, normalisation and leaky ReLU in place, stored statistics folded into the weights.
/// It can be used from several threads, but the number of threads of BLAS is a setting of the
/// process.
class VoxelDecoder {
 public:
  /// Keeps what it needs of the model. Throws InputError where its statistics are missing.
  explicit VoxelDecoder(const Model& model);

  /// The field of a code (network.code_size() values) at one of the network's resolutions, m.
  /// Throws InputError for another resolution, naming those that there are.
  VoxelGrid<float> decode(std::span<const float> code, int resolution, int threads) const;

  /// Floating-point operations that `decode` needs, for comparison with the machine's rate.
  double operations(int resolution) const;

 private:
  struct Block {
    TransposedConvolution convolution;
    std::vector<float> scale, shift;  ///< of the normalisation; empty where it is in the weights
  };

  void normalise(std::vector<float>& volume, const Block& block, int threads) const;

  NetworkOptions network_;
  float field_unit_ = 1;
  std::vector<float> linear_weight_, linear_bias_;
  std::vector<Block> blocks_;
  std::vector<TransposedConvolution> heads_;
};

}  // namespace fracbench::neural
