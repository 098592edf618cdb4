#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/voxel_grid.h"
#include "neural/field_decoder.h"
#include "neural/transposed_convolution.h"

namespace fracbench::neural {

/// The code-to-voxel decoder G of the paper: normalisation and leaky ReLU in place, stored
/// statistics folded into the weights.
class VoxelDecoder : public FieldDecoder {
 public:
  /// Throws InputError where its statistics are missing.
  explicit VoxelDecoder(const Model& model);

  VoxelGrid<float> decode(const FieldSource& source, int resolution, int threads) const override;

 private:
  struct Block {
    TransposedConvolution convolution;
    std::vector<float> scale, shift;  ///< of the normalisation; empty where it is in the weights
  };

  void finish(std::span<float> volume, const Block& block, int threads) const;

  const NetworkOptions& network_;
  float field_unit_ = 1;
  std::span<const float> linear_weight_, linear_bias_;  ///< of the model
  std::vector<Block> blocks_;
  std::vector<TransposedConvolution> heads_;
};

}  // namespace fracbench::neural
