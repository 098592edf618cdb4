#pragma once

#include <torch/types.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace fracbench::training {

/// Adam (Kingma and Ba, 2015) with the usual constants: decay rates 0.9 and 0.999, epsilon 1e-8.
/// Its state is open, so that a check point holds all of it; how libtorch's own optimiser keeps its
/// state differs between versions 1 and 2.
class Adam {
 public:
  /// `trained` are leaf tensors that take gradients.
  explicit Adam(std::map<std::string, torch::Tensor> trained);

  /// One step down the gradients of those that have one, which are then cleared.
  void step(double learning_rate);

  std::int64_t steps = 0;
  std::map<std::string, torch::Tensor> first, second;  ///< moments, by name

 private:
  std::map<std::string, torch::Tensor> trained_;
};

}  // namespace fracbench::training
