#pragma once

#include <torch/types.h>

#include <map>
#include <string>
#include <vector>

#include "core/random.h"
#include "neural/model.h"
#include "neural/network_options.h"

namespace fracbench::training {

/// The code-to-voxel decoder as libtorch trains it. The same function as neural::VoxelDecoder.
class VoxelNetwork {
 public:
  /// Weights as libtorch would initialise them (uniform, +-1 / sqrt(fan in)), but from our own
  /// generator, so that they do not depend on its version.
  VoxelNetwork(const neural::NetworkOptions& options, Random& random, torch::Device device);

  /// The fields of one code (a tensor of network.code_size() values), by resolution: r x r x r.
  /// While training, running statistics take note of the sample where they are wanted.
  std::map<int, torch::Tensor> decode(const torch::Tensor& code, bool training);

  /// By the names of neural::weight_specs.
  std::map<std::string, torch::Tensor>& weights() { return weights_; }
  /// "block0.mean" and "block0.variance", not trained.
  std::map<std::string, torch::Tensor>& statistics() { return statistics_; }

  /// With this set, `decode` adds the statistics of each sample to `statistics`, for their mean.
  bool sum_statistics = false;

 private:
  torch::Tensor normalise(const torch::Tensor& volume, const neural::DecoderLayer& layer,
                          bool training);

  neural::NetworkOptions options_;
  std::vector<neural::DecoderLayer> blocks_, heads_;
  std::map<std::string, torch::Tensor> weights_, statistics_;
};

/// Of our arrays and libtorch's: copies, on the processor.
torch::Tensor tensor_of(const std::vector<float>& values, torch::IntArrayRef shape);
std::vector<float> values_of(const torch::Tensor& tensor);

}  // namespace fracbench::training
