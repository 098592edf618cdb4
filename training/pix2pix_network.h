#pragma once

#include "training/adam.h"
#include "training/network.h"

namespace fracbench::training {

/// neural::Pix2pixDecoder as libtorch trains it, against a discriminator of patches (Isola et al.
/// 2017, section 3.2, with convolutions in 3D): the generator's loss is 100 times the mean absolute
/// error plus the cross-entropy of being taken for true.
class Pix2pixNetwork : public Network {
 public:
  Pix2pixNetwork(const neural::NetworkOptions& options, Random& random, torch::Device device);

  /// The field of an impulse volume, both r x r x r.
  torch::Tensor generate(const torch::Tensor& volume);

  /// Also takes a step of the discriminator. Only kind l2, which stands for pix2pix's own loss.
  torch::Tensor loss(const Sample& sample, Loss kind, double learning_rate,
                     Random& random) override;
  TensorMap further() override;

 private:
  torch::Tensor judge(const torch::Tensor& volume, const torch::Tensor& field);
  torch::Tensor normalised(const torch::Tensor& volume, const torch::Tensor& scale,
                           const torch::Tensor& shift) const;

  neural::NetworkOptions options_;
  TensorMap judge_weights_;
  Adam judge_adam_;
  torch::Tensor judge_steps_;  ///< of judge_adam_, as a tensor for check points
};

}  // namespace fracbench::training
