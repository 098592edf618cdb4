#pragma once

#include "training/network.h"

namespace fracbench::training {

/// neural::ImplicitDecoder as libtorch trains it: each step takes some thousand voxels of one
/// pattern, drawn anew.
class ImplicitNetwork : public Network {
 public:
  ImplicitNetwork(const neural::NetworkOptions& options, Random& random, torch::Device device);

  /// Values at places (n x 3) for one code.
  torch::Tensor evaluate(const torch::Tensor& code, const torch::Tensor& places);

  /// The mean squared error; other kinds need whole fields (InputError).
  torch::Tensor loss(const Sample& sample, Loss kind, double learning_rate,
                     Random& random) override;

 private:
  torch::Device device_;
};

}  // namespace fracbench::training
