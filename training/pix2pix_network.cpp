#include "training/pix2pix_network.h"

#include <torch/torch.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "training/transposed_convolution.h"

namespace fracbench::training {

namespace {

constexpr double kFieldWeight = 100;
constexpr int kJudgeLayers = 3;
constexpr int kGroups = 8;

/// Of the discriminator: three halvings and a layer that gives one number for each patch.
std::vector<neural::WeightSpec> judge_specs(const neural::NetworkOptions& options) {
  const int first = neural::unet_channels(options).front();
  std::vector<neural::WeightSpec> list;
  int from = 2;
  for (int k = 0; k < kJudgeLayers; ++k) {
    const std::string name = "judge" + std::to_string(k);
    const int to = first << k;
    list.push_back({name + ".weight", {to, from, 4, 4, 4}});
    list.push_back({name + ".bias", {to}});
    if (k > 0) {
      list.push_back({name + ".scale", {to}});
      list.push_back({name + ".shift", {to}});
    }
    from = to;
  }
  list.push_back({"judge3.weight", {1, from, 3, 3, 3}});
  list.push_back({"judge3.bias", {1}});
  return list;
}

torch::Tensor halved(const torch::Tensor& volume, const TensorMap& weights,
                     const std::string& name) {
  return torch::conv3d(volume, weights.at(name + ".weight"), weights.at(name + ".bias"), 2, 1);
}

torch::Tensor as_batch(const torch::Tensor& volume) { return volume.unsqueeze(0).unsqueeze(0); }

torch::Tensor cross_entropy(const torch::Tensor& judged, double wanted) {
  return torch::binary_cross_entropy_with_logits(judged, torch::full_like(judged, wanted));
}

}  // namespace

Pix2pixNetwork::Pix2pixNetwork(const neural::NetworkOptions& options, Random& random,
                               torch::Device device)
    : options_(options),
      judge_weights_(initial_weights(judge_specs(options), random, device)),
      judge_adam_(judge_weights_),
      judge_steps_(torch::zeros({1})) {
  weights_ = initial_weights(neural::weight_specs(options), random, device);
}

torch::Tensor Pix2pixNetwork::normalised(const torch::Tensor& volume, const torch::Tensor& scale,
                                         const torch::Tensor& shift) const {
  const torch::Tensor values =
      options_.normalisation == neural::Normalisation::group
          ? torch::group_norm(volume, kGroups, scale, shift, options_.epsilon)
          : torch::batch_norm(volume, scale, shift, {}, {}, true, 0.1, options_.epsilon, true);
  return torch::leaky_relu(values, options_.slope);
}

torch::Tensor Pix2pixNetwork::generate(const torch::Tensor& volume) {
  const auto depth = static_cast<int>(neural::unet_channels(options_).size());
  std::vector<torch::Tensor> levels;
  torch::Tensor values = as_batch(volume);
  for (int k = 0; k < depth; ++k) {
    const std::string name = "down" + std::to_string(k);
    values = halved(values, weights_, name);
    values = k == 0 ? torch::leaky_relu(values, options_.slope)
                    : normalised(values, weights_[name + ".scale"], weights_[name + ".shift"]);
    levels.push_back(values);
  }
  for (int k = depth - 1; k >= 0; --k) {
    const std::string name = "up" + std::to_string(k);
    if (k < depth - 1) values = torch::cat({values, levels[static_cast<std::size_t>(k)]}, 1);
    values = transposed_convolution(values, weights_[name + ".weight"]);
    if (k == 0) break;
    values = normalised(values + per_channel(weights_[name + ".bias"]), weights_[name + ".scale"],
                        weights_[name + ".shift"]);
  }
  return torch::tanh(values).squeeze(0).squeeze(0);
}

torch::Tensor Pix2pixNetwork::judge(const torch::Tensor& volume, const torch::Tensor& field) {
  torch::Tensor values = torch::cat({as_batch(volume), as_batch(field)}, 1);
  for (int k = 0; k < kJudgeLayers; ++k) {
    const std::string name = "judge" + std::to_string(k);
    values = halved(values, judge_weights_, name);
    values = k == 0 ? torch::leaky_relu(values, options_.slope)
                    : normalised(values, judge_weights_[name + ".scale"],
                                 judge_weights_[name + ".shift"]);
  }
  return torch::conv3d(values, judge_weights_["judge3.weight"], judge_weights_["judge3.bias"], 1,
                       1);
}

torch::Tensor Pix2pixNetwork::loss(const Sample& sample, Loss kind, double learning_rate, Random&) {
  if (kind != Loss::l2)
    throw InputError("training: the pix2pix decoder has a loss of its own; set loss l2");
  const torch::Tensor& target = sample.fields.begin()->second;
  const torch::Tensor field = generate(sample.volume);
  const torch::Tensor of_judge = (cross_entropy(judge(sample.volume, target), 1) +
                                  cross_entropy(judge(sample.volume, field.detach()), 0)) /
                                 2;
  of_judge.backward();
  judge_adam_.steps = judge_steps_.item<std::int64_t>();
  judge_adam_.step(learning_rate);
  judge_steps_.fill_(static_cast<double>(judge_adam_.steps));
  // The judge is not to learn from how it is deceived.
  for (auto& [name, tensor] : judge_weights_) tensor.requires_grad_(false);
  const torch::Tensor value =
      kFieldWeight * torch::l1_loss(field, target) + cross_entropy(judge(sample.volume, field), 1);
  for (auto& [name, tensor] : judge_weights_) tensor.requires_grad_(true);
  return value;
}

TensorMap Pix2pixNetwork::further() {
  TensorMap list{{"judge_steps", judge_steps_}};
  for (auto& [name, tensor] : judge_weights_) list["weights/" + name] = tensor;
  for (auto& [name, tensor] : judge_adam_.first) list["first/" + name] = tensor;
  for (auto& [name, tensor] : judge_adam_.second) list["second/" + name] = tensor;
  return list;
}

}  // namespace fracbench::training
