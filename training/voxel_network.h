#pragma once

#include <map>
#include <vector>

#include "training/network.h"

namespace fracbench::training {

/// The code-to-voxel decoder as libtorch trains it. The same function as neural::VoxelDecoder.
class VoxelNetwork : public Network {
 public:
  VoxelNetwork(const neural::NetworkOptions& options, Random& random, torch::Device device);

  /// The fields of one code (a tensor of network.code_size() values), by resolution: r x r x r.
  /// While training, running statistics take note of the sample where they are wanted.
  std::map<int, torch::Tensor> decode(const torch::Tensor& code, bool training);

  torch::Tensor loss(const Sample& sample, Loss kind, double learning_rate,
                     Random& random) override;
  void begin_statistics() override;
  void add_statistics(const Sample& sample) override;
  void end_statistics(std::size_t samples) override;

 private:
  /// What a block makes of its convolution: bias, normalisation, activation.
  torch::Tensor activated(const torch::Tensor& convolved, const neural::DecoderLayer& layer,
                          bool training);
  torch::Tensor normalised(const torch::Tensor& volume, const neural::DecoderLayer& layer,
                           bool training);
  /// Whether a sample is normalised by nothing but its own mean and variance, which nobody else
  /// wants to know.
  bool goes_by_sample_alone(bool training) const;

  neural::NetworkOptions options_;
  std::vector<neural::DecoderLayer> blocks_, heads_;
  bool sum_statistics_ = false;
};

}  // namespace fracbench::training
