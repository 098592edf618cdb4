#pragma once

#include "neural/field_decoder.h"

namespace fracbench::neural {

/// A perceptron of code and place, f(Z, p), after DeepSDF (Park et al. 2019): eight hidden layers
/// with ReLU, the input given again to the fifth, tanh at the end. It is evaluated at every voxel.
class ImplicitDecoder : public FieldDecoder {
 public:
  explicit ImplicitDecoder(const Model& model) : model_(model) {}

  VoxelGrid<float> decode(const FieldSource& source, int resolution, int threads) const override;

 private:
  const Model& model_;
};

}  // namespace fracbench::neural
