#include "training/voxel_network.h"

#include <torch/torch.h>

#include "training/normalised_activation.h"
#include "training/transposed_convolution.h"

namespace fracbench::training {

namespace {

constexpr int kGroups = 8;
// Of running statistics: libtorch's default.
constexpr double kMomentum = 0.1;

}  // namespace

VoxelNetwork::VoxelNetwork(const neural::NetworkOptions& options, Random& random,
                           torch::Device device)
    : options_(options),
      blocks_(neural::decoder_blocks(options)),
      heads_(neural::decoder_heads(options)) {
  weights_ = initial_weights(neural::weight_specs(options), random, device);
  for (const neural::DecoderLayer& layer : blocks_) {
    statistics_[layer.name + ".mean"] = torch::zeros({layer.out}, device);
    statistics_[layer.name + ".variance"] = torch::ones({layer.out}, device);
  }
}

torch::Tensor VoxelNetwork::activated(const torch::Tensor& convolved,
                                      const neural::DecoderLayer& layer, bool training) {
  const torch::Tensor& scale = weights_[layer.name + ".scale"];
  const torch::Tensor& shift = weights_[layer.name + ".shift"];
  if (goes_by_sample_alone(training)) {
    // Normalisation takes the mean off, and whatever bias is in it.
    return normalised_activation(convolved, scale, shift, options_.epsilon, options_.slope);
  }
  const torch::Tensor volume = convolved + per_channel(weights_[layer.name + ".bias"]);
  return torch::leaky_relu(normalised(volume, layer, training), options_.slope);
}

bool VoxelNetwork::goes_by_sample_alone(bool training) const {
  if (options_.normalisation != neural::Normalisation::batch || sum_statistics_) return false;
  return options_.statistics == neural::Statistics::sample ||
         (training && options_.statistics == neural::Statistics::reestimated);
}

torch::Tensor VoxelNetwork::normalised(const torch::Tensor& volume,
                                       const neural::DecoderLayer& layer, bool training) {
  const torch::Tensor& scale = weights_[layer.name + ".scale"];
  const torch::Tensor& shift = weights_[layer.name + ".shift"];
  if (options_.normalisation == neural::Normalisation::group) {
    return torch::group_norm(volume, kGroups, scale, shift, options_.epsilon);
  }
  torch::Tensor& mean = statistics_[layer.name + ".mean"];
  torch::Tensor& variance = statistics_[layer.name + ".variance"];
  if (sum_statistics_) {
    const torch::NoGradGuard none;
    mean += volume.mean({0, 2, 3, 4});
    variance += volume.var({0, 2, 3, 4}, /*unbiased=*/false);
  }
  const bool of_sample = training || options_.statistics == neural::Statistics::sample;
  const bool note = training && options_.statistics == neural::Statistics::running;
  return torch::batch_norm(volume, scale, shift, of_sample && !note ? torch::Tensor() : mean,
                           of_sample && !note ? torch::Tensor() : variance, of_sample, kMomentum,
                           options_.epsilon, /*cudnn_enabled=*/true);
}

torch::Tensor VoxelNetwork::loss(const Sample& sample, Loss kind, double, Random&) {
  const auto decoded = decode(sample.code, /*training=*/true);
  torch::Tensor sum;
  for (const auto& [r, field] : decoded) {
    const torch::Tensor value = field_loss(field, sample.fields.at(r), kind);
    sum = sum.defined() ? sum + value : value;
  }
  return sum / static_cast<double>(decoded.size());
}

void VoxelNetwork::begin_statistics() {
  for (auto& [name, tensor] : statistics_) tensor.zero_();
  sum_statistics_ = true;
}

void VoxelNetwork::add_statistics(const Sample& sample) {
  const torch::NoGradGuard none;
  decode(sample.code, /*training=*/true);
}

void VoxelNetwork::end_statistics(std::size_t samples) {
  sum_statistics_ = false;
  for (auto& [name, tensor] : statistics_) tensor /= static_cast<double>(samples);
}

std::map<int, torch::Tensor> VoxelNetwork::decode(const torch::Tensor& code, bool training) {
  torch::Tensor volume = torch::leaky_relu(
      torch::linear(code.unsqueeze(0), weights_["linear.weight"], weights_["linear.bias"]),
      options_.slope);
  volume = volume.reshape({1, -1, neural::kBaseSide, neural::kBaseSide, neural::kBaseSide});
  std::map<int, torch::Tensor> fields;
  for (const neural::DecoderLayer& layer : blocks_) {
    volume = activated(transposed_convolution(volume, weights_[layer.name + ".weight"]), layer,
                       training);
    const int r = 4 * layer.side;
    for (const neural::DecoderLayer& head : heads_) {
      if (2 * head.side != r) continue;
      fields[r] = torch::tanh(transposed_convolution(volume, weights_[head.name + ".weight"]))
                      .reshape({r, r, r});
    }
  }
  return fields;
}

}  // namespace fracbench::training
