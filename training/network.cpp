#include "training/network.h"

#include <torch/torch.h>

#include <algorithm>
#include <cmath>

#include "training/implicit_network.h"
#include "training/pix2pix_network.h"
#include "training/voxel_network.h"

namespace fracbench::training {

namespace {

constexpr double kEikonalWeight = 0.1;

torch::Tensor gradient_along(const torch::Tensor& field, int axis) {
  const auto n = field.size(axis);
  const double spacing = 2.0 / static_cast<double>(n);
  return (field.slice(axis, 1) - field.slice(axis, 0, n - 1)) / spacing;
}

}  // namespace

torch::Tensor field_loss(const torch::Tensor& field, const torch::Tensor& target, Loss kind) {
  if (kind == Loss::dice) {
    const double edge = 2.0 / static_cast<double>(field.size(0));
    const torch::Tensor inside = torch::sigmoid(field / edge),
                        wanted = target.gt(0).to(torch::kF32);
    return 1 - 2 * (inside * wanted).sum() / (inside.sum() + wanted.sum());
  }
  torch::Tensor value = torch::mse_loss(field, target);
  if (kind == Loss::eikonal) {
    const auto n = field.size(0) - 1;
    const auto inner = [&](int axis) {
      torch::Tensor g = gradient_along(field, axis);
      for (int other = 0; other < 3; ++other) {
        if (other != axis) g = g.slice(other, 0, n);
      }
      return g;
    };
    const torch::Tensor norm =
        (inner(0).square() + inner(1).square() + inner(2).square() + 1e-12).sqrt();
    value = value + kEikonalWeight * (norm - 1).square().mean();
  }
  return value;
}

torch::Tensor per_channel(const torch::Tensor& values) { return values.reshape({1, -1, 1, 1, 1}); }

torch::Tensor tensor_of(const std::vector<float>& values, torch::IntArrayRef shape) {
  return torch::tensor(values, torch::kFloat32).reshape(shape);
}

torch::Tensor in_order(const torch::Tensor& tensor) {
  return tensor.detach().to(torch::kCPU).contiguous();
}

std::vector<float> values_of(const torch::Tensor& tensor) {
  const torch::Tensor plain = in_order(tensor);
  const float* from = plain.data_ptr<float>();
  return {from, from + plain.numel()};
}

TensorMap initial_weights(const std::vector<neural::WeightSpec>& specs, Random& random,
                          torch::Device device) {
  TensorMap weights;
  double bound = 0;  // of the layer at hand: a bias comes after its weight
  for (const neural::WeightSpec& spec : specs) {
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
    weights[spec.name] = tensor_of(values, shape).to(device).requires_grad_();
  }
  return weights;
}

std::unique_ptr<Network> make_network(const neural::NetworkOptions& options, Random& random,
                                      torch::Device device) {
  switch (options.decoder) {
    case neural::Decoder::voxel:
      return std::make_unique<VoxelNetwork>(options, random, device);
    case neural::Decoder::implicit:
      return std::make_unique<ImplicitNetwork>(options, random, device);
    case neural::Decoder::pix2pix:
      return std::make_unique<Pix2pixNetwork>(options, random, device);
  }
  return nullptr;
}

}  // namespace fracbench::training
