#include "training/adam.h"

#include <torch/torch.h>

#include <cmath>

namespace fracbench::training {

namespace {

constexpr double kFirstDecay = 0.9, kSecondDecay = 0.999, kEpsilon = 1e-8;

}  // namespace

Adam::Adam(std::map<std::string, torch::Tensor> trained) : trained_(std::move(trained)) {
  for (const auto& [name, tensor] : trained_) {
    first[name] = torch::zeros_like(tensor);
    second[name] = torch::zeros_like(tensor);
  }
}

void Adam::step(double learning_rate) {
  const torch::NoGradGuard none;
  ++steps;
  const double rate = learning_rate / (1 - std::pow(kFirstDecay, steps));
  const double scale = std::sqrt(1 - std::pow(kSecondDecay, steps));
  for (auto& [name, tensor] : trained_) {
    torch::Tensor& gradient = tensor.mutable_grad();
    if (!gradient.defined()) continue;
    torch::Tensor& m = first[name];
    torch::Tensor& v = second[name];
    m.mul_(kFirstDecay).add_(gradient, 1 - kFirstDecay);
    v.mul_(kSecondDecay).addcmul_(gradient, gradient, 1 - kSecondDecay);
    tensor.addcdiv_(m, v.sqrt().div_(scale).add_(kEpsilon), -rate);
    gradient.reset();
  }
}

}  // namespace fracbench::training
