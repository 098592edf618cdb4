#include "training/voxel_network.h"

#include <torch/torch.h>

#include <cmath>

namespace fracbench::training {

namespace {

constexpr int kGroups = 8;
// Of running statistics: libtorch's default.
constexpr double kMomentum = 0.1;

/// Transposed convolution of kernel 4, stride 2, padding 1, as one convolution of kernel 2 with
/// eight times the outputs, one for each parity, whose voxels are then put in their places (see
/// neural/transposed_convolution.h). libtorch does its own transposed convolutions several times
/// slower on a processor.
torch::Tensor transposed_convolution(const torch::Tensor& input, const torch::Tensor& weight) {
  const auto in = weight.size(0), out = weight.size(1);
  const auto side = input.size(2);
  // Tap 3 - p - 2 a takes input a of a window to the output of parity p: along each axis the kernel
  // read backwards, as [a][1 - ...]: (3, 2, 1, 0) = (a = 0: p = 0, p = 1; a = 1: p = 0, p = 1).
  const torch::Tensor windows =
      weight.flip({2, 3, 4})
          .reshape({in, out, 2, 2, 2, 2, 2, 2})  // in, out, az, pz, ay, py, ax, px
          .permute({1, 3, 5, 7, 0, 2, 4, 6})     // out, pz, py, px, in, az, ay, ax
          .reshape({8 * out, in, 2, 2, 2});
  const torch::Tensor values = torch::conv3d(input, windows, {}, 1, 1);
  const auto n = side + 1;
  // Window j gives output 2 j - p: two of them for each j, of which the first and the last lie
  // outside. As 2 (j + 1) - p - 1 they are in order with p reversed.
  return values.reshape({out, 2, 2, 2, n, n, n})
      .flip({1, 2, 3})
      .permute({0, 4, 1, 5, 2, 6, 3})
      .reshape({1, out, 2 * n, 2 * n, 2 * n})
      .slice(2, 1, 2 * n - 1)
      .slice(3, 1, 2 * n - 1)
      .slice(4, 1, 2 * n - 1);
}

torch::Tensor per_channel(const torch::Tensor& values) { return values.reshape({1, -1, 1, 1, 1}); }

}  // namespace

torch::Tensor tensor_of(const std::vector<float>& values, torch::IntArrayRef shape) {
  return torch::tensor(values, torch::kFloat32).reshape(shape);
}

std::vector<float> values_of(const torch::Tensor& tensor) {
  const torch::Tensor plain = tensor.detach().to(torch::kCPU).contiguous();
  const float* from = plain.data_ptr<float>();
  return {from, from + plain.numel()};
}

VoxelNetwork::VoxelNetwork(const neural::NetworkOptions& options, Random& random,
                           torch::Device device)
    : options_(options),
      blocks_(neural::decoder_blocks(options)),
      heads_(neural::decoder_heads(options)) {
  double bound = 0;  // of the layer at hand: a bias comes after its weight
  for (const neural::WeightSpec& spec : neural::weight_specs(options)) {
    std::vector<float> values(spec.size());
    if (spec.name.ends_with(".scale")) {
      std::fill(values.begin(), values.end(), 1.0f);
    } else if (!spec.name.ends_with(".shift")) {
      if (spec.shape.size() > 1) {
        bound = 1 / std::sqrt(static_cast<double>(spec.size()) / spec.shape[0]);
      }
      for (float& value : values) value = static_cast<float>(random.uniform(-bound, bound));
    }
    const std::vector<std::int64_t> shape(spec.shape.begin(), spec.shape.end());
    weights_[spec.name] = tensor_of(values, shape).to(device).requires_grad_();
  }
  for (const neural::DecoderLayer& layer : blocks_) {
    statistics_[layer.name + ".mean"] = torch::zeros({layer.out}, device);
    statistics_[layer.name + ".variance"] = torch::ones({layer.out}, device);
  }
}

torch::Tensor VoxelNetwork::normalise(const torch::Tensor& volume,
                                      const neural::DecoderLayer& layer, bool training) {
  const torch::Tensor& scale = weights_[layer.name + ".scale"];
  const torch::Tensor& shift = weights_[layer.name + ".shift"];
  if (options_.normalisation == neural::Normalisation::group) {
    return torch::group_norm(volume, kGroups, scale, shift, options_.epsilon);
  }
  torch::Tensor& mean = statistics_[layer.name + ".mean"];
  torch::Tensor& variance = statistics_[layer.name + ".variance"];
  if (sum_statistics) {
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

std::map<int, torch::Tensor> VoxelNetwork::decode(const torch::Tensor& code, bool training) {
  torch::Tensor volume = torch::leaky_relu(
      torch::mv(weights_["linear.weight"], code) + weights_["linear.bias"], options_.slope);
  volume = volume.reshape({1, -1, neural::kBaseSide, neural::kBaseSide, neural::kBaseSide});
  std::map<int, torch::Tensor> fields;
  for (const neural::DecoderLayer& layer : blocks_) {
    volume = transposed_convolution(volume, weights_[layer.name + ".weight"]) +
             per_channel(weights_[layer.name + ".bias"]);
    volume = torch::leaky_relu(normalise(volume, layer, training), options_.slope);
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
