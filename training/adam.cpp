#include "training/adam.h"

#include <torch/torch.h>

#include <cmath>

namespace fracbench::training {

namespace {

constexpr double kFirstDecay = 0.9, kSecondDecay = 0.999, kEpsilon = 1e-8;

/// What a step takes besides the numbers it changes.
struct Step {
  double rate, scale;
};

void step_on_any_device(torch::Tensor& values, torch::Tensor& m, torch::Tensor& v,
                        const torch::Tensor& gradient, const Step& step) {
  m.mul_(kFirstDecay).add_(gradient, 1 - kFirstDecay);
  v.mul_(kSecondDecay).addcmul_(gradient, gradient, 1 - kSecondDecay);
  values.addcdiv_(m, v.sqrt().div_(step.scale).add_(kEpsilon), -step.rate);
}

/// The same in one pass: with batches of one, a step has less to compute than to read and write,
/// and eight passes over all weights cost a quarter of it.
void step_on_processor(torch::Tensor& values, torch::Tensor& m, torch::Tensor& v,
                       const torch::Tensor& gradient, const Step& step) {
  const torch::Tensor rows = gradient.contiguous();
  const auto rate = static_cast<float>(step.rate), scale = static_cast<float>(1 / step.scale);
  constexpr auto kFirst = static_cast<float>(kFirstDecay),
                 kSecond = static_cast<float>(kSecondDecay), kSmall = static_cast<float>(kEpsilon);
  float* const value = values.data_ptr<float>();
  float* const first = m.data_ptr<float>();
  float* const second = v.data_ptr<float>();
  const float* const slope = rows.data_ptr<float>();
  const std::int64_t count = values.numel();
#pragma omp parallel for simd num_threads(torch::get_num_threads())
  for (std::int64_t k = 0; k < count; ++k) {
    const float g = slope[k];
    first[k] = kFirst * first[k] + (1 - kFirst) * g;
    second[k] = kSecond * second[k] + (1 - kSecond) * g * g;
    value[k] -= rate * first[k] / (std::sqrt(second[k]) * scale + kSmall);
  }
}

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
  const Step step{.rate = learning_rate / (1 - std::pow(kFirstDecay, steps)),
                  .scale = std::sqrt(1 - std::pow(kSecondDecay, steps))};
  for (auto& [name, tensor] : trained_) {
    torch::Tensor& gradient = tensor.mutable_grad();
    if (!gradient.defined()) continue;
    const auto apply =
        tensor.is_cpu() && tensor.is_contiguous() ? step_on_processor : step_on_any_device;
    apply(tensor, first[name], second[name], gradient, step);
    gradient.reset();
  }
}

}  // namespace fracbench::training
