#pragma once

#include <torch/types.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/random.h"
#include "neural/network_options.h"
#include "training/training.h"

namespace fracbench::training {

using TensorMap = std::map<std::string, torch::Tensor>;

/// One pattern, ready for a step.
struct Sample {
  torch::Tensor code;
  torch::Tensor volume;                 ///< impulse_volume, r x r x r; for pix2pix only
  std::map<int, torch::Tensor> fields;  ///< by resolution, r x r x r
};

/// A network as libtorch trains it; the same function as neural::FieldDecoder of its kind.
class Network {
 public:
  virtual ~Network() = default;

  /// What is to be made small for this sample.
  virtual torch::Tensor loss(const Sample& sample, Loss kind, double learning_rate,
                             Random& random) = 0;

  /// Statistics over all samples with the weights as they are: started, told of each, ended.
  virtual void begin_statistics() {}
  virtual void add_statistics(const Sample&) {}
  virtual void end_statistics(std::size_t) {}

  /// By the names of neural::weight_specs.
  TensorMap& weights() { return weights_; }
  /// "block0.mean" and so on, not trained.
  TensorMap& statistics() { return statistics_; }
  /// Whatever else changes while it is trained, for check points.
  virtual TensorMap further() { return {}; }

 protected:
  TensorMap weights_, statistics_;
};

/// The network of the options' kind, with weights from our own generator.
std::unique_ptr<Network> make_network(const neural::NetworkOptions& options, Random& random,
                                      torch::Device device);

/// Weights as libtorch would initialise them (uniform, +-1 / sqrt(fan in); scales 1, shifts 0), but
/// from our own generator, so that they do not depend on its version.
TensorMap initial_weights(const std::vector<neural::WeightSpec>& specs, Random& random,
                          torch::Device device);

/// Of values by channel: 1 x channels x 1 x 1 x 1.
torch::Tensor per_channel(const torch::Tensor& values);

/// The loss of a whole field, r x r x r.
torch::Tensor field_loss(const torch::Tensor& field, const torch::Tensor& target, Loss kind);

/// Of our arrays and libtorch's: copies, on the processor.
torch::Tensor tensor_of(const std::vector<float>& values, torch::IntArrayRef shape);
std::vector<float> values_of(const torch::Tensor& tensor);
/// The tensor itself where it is on the processor and contiguous, else a copy that is.
torch::Tensor in_order(const torch::Tensor& tensor);

}  // namespace fracbench::training
