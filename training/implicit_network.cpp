#include "training/implicit_network.h"

#include <torch/torch.h>

#include <string>
#include <vector>

#include "core/error.h"

namespace fracbench::training {

namespace {

// Voxels of a step, as many as DeepSDF takes samples.
constexpr std::int64_t kSamples = 16384;

}  // namespace

ImplicitNetwork::ImplicitNetwork(const neural::NetworkOptions& options, Random& random,
                                 torch::Device device)
    : device_(device) {
  weights_ = initial_weights(neural::weight_specs(options), random, device);
}

torch::Tensor ImplicitNetwork::evaluate(const torch::Tensor& code, const torch::Tensor& places) {
  const torch::Tensor input =
      torch::cat({code.unsqueeze(0).expand({places.size(0), code.size(0)}), places}, 1);
  torch::Tensor values = input;
  for (int k = 0; k <= neural::kHiddenLayers; ++k) {
    const std::string name = "layer" + std::to_string(k);
    if (k == neural::kSkipLayer) values = torch::cat({values, input}, 1);
    values = torch::addmm(weights_[name + ".bias"], values, weights_[name + ".weight"].t());
    if (k < neural::kHiddenLayers) values = torch::relu(values);
  }
  return torch::tanh(values.squeeze(1));
}

torch::Tensor ImplicitNetwork::loss(const Sample& sample, Loss kind, double, Random& random) {
  if (kind != Loss::l2)
    throw InputError("training: the implicit decoder is trained with loss l2 only");
  torch::Tensor sum;
  for (const auto& [r, field] : sample.fields) {
    const auto count = static_cast<std::uint64_t>(field.numel());
    std::vector<std::int64_t> voxels;
    std::vector<float> places;
    for (std::int64_t n = 0; n < kSamples; ++n) {
      const auto voxel = static_cast<std::int64_t>(random.below(count));
      voxels.push_back(voxel);
      for (const std::int64_t at : {voxel % r, voxel / r % r, voxel / (r * r)}) {
        places.push_back(static_cast<float>(-1 + (2.0 * static_cast<double>(at) + 1) / r));
      }
    }
    const torch::Tensor chosen = torch::tensor(voxels, torch::kInt64).to(device_);
    const torch::Tensor value =
        torch::mse_loss(evaluate(sample.code, tensor_of(places, {kSamples, 3}).to(device_)),
                        field.flatten().index_select(0, chosen));
    sum = sum.defined() ? sum + value : value;
  }
  return sum / static_cast<double>(sample.fields.size());
}

}  // namespace fracbench::training
