#include "training/normalised_activation.h"

#include <torch/torch.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fracbench::training {

namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

/// Voxels whose sum is made in single precision, in as many parts as there are lanes; such sums are
/// added in double precision.
constexpr std::int64_t kStretch = 1024;

/// The sums of a(k) and of a(k) b(k) for k in [0, count), all of single precision.
struct Sums {
  double a = 0, product = 0;
};
template <typename A, typename B>
Sums sums_of(std::int64_t count, const A& a, const B& b) {
  Sums sums;
  for (std::int64_t begin = 0; begin < count; begin += kStretch) {
    const std::int64_t end = std::min(begin + kStretch, count);
    float part = 0, product = 0;
#pragma omp simd reduction(+ : part, product)
    for (std::int64_t k = begin; k < end; ++k) {
      const float value = a(k);
      part += value;
      product += value * b(k);
    }
    sums.a += part;
    sums.product += product;
  }
  return sums;
}

/// One pass for the mean, one for the variance, one for the result; back two passes: the fewest
/// that do without differences of large numbers.
class NormalisedActivation : public torch::autograd::Function<NormalisedActivation> {
 public:
  static torch::Tensor forward(AutogradContext* context, const torch::Tensor& volume,
                               const torch::Tensor& scale, const torch::Tensor& shift,
                               double epsilon, double slope) {
    const torch::Tensor from = volume.contiguous();
    const auto channels = from.size(1), count = from.numel() / channels;
    torch::Tensor result = torch::empty_like(from);
    torch::Tensor mean = torch::empty({channels}, from.options()),
                  inverse = torch::empty_like(mean);
    const float* const x = from.data_ptr<float>();
    const float* const scales = scale.data_ptr<float>();
    const float* const shifts = shift.data_ptr<float>();
    float* const y = result.data_ptr<float>();
    float* const means = mean.data_ptr<float>();
    float* const inverses = inverse.data_ptr<float>();
    const auto leak = static_cast<float>(slope);
#pragma omp parallel for num_threads(torch::get_num_threads())
    for (std::int64_t c = 0; c < channels; ++c) {
      const float* const in = x + c * count;
      const auto n = static_cast<double>(count);
      const auto none = [](std::int64_t) { return 0.0f; };
      const auto input = [&](std::int64_t k) { return in[k]; };
      const auto m = static_cast<float>(sums_of(count, input, none).a / n);
      const auto deviation = [&](std::int64_t k) { return in[k] - m; };
      const double variance = sums_of(count, deviation, deviation).product / n;
      means[c] = m;
      inverses[c] = static_cast<float>(1 / std::sqrt(variance + epsilon));
      const float factor = scales[c] * inverses[c], offset = shifts[c] - m * factor;
      float* const out = y + c * count;
#pragma omp simd
      for (std::int64_t k = 0; k < count; ++k) {
        const float value = in[k] * factor + offset;
        out[k] = value > 0 ? value : leak * value;
      }
    }
    context->save_for_backward({from, scale, shift, mean, inverse});
    context->saved_data["slope"] = slope;
    return result;
  }

  static variable_list backward(AutogradContext* context, const variable_list& gradients) {
    const variable_list saved = context->get_saved_variables();
    const torch::Tensor &from = saved[0], gradient = gradients[0].contiguous();
    const auto leak = static_cast<float>(context->saved_data["slope"].toDouble());
    const auto channels = from.size(1), count = from.numel() / channels;
    torch::Tensor of_volume = torch::empty_like(from), of_scale = torch::empty_like(saved[3]),
                  of_shift = torch::empty_like(saved[3]);
    const float* const x = from.data_ptr<float>();
    const float* const scales = saved[1].data_ptr<float>();
    const float* const shifts = saved[2].data_ptr<float>();
    const float* const means = saved[3].data_ptr<float>();
    const float* const inverses = saved[4].data_ptr<float>();
    const float* const dy = gradient.data_ptr<float>();
    float* const dx = of_volume.data_ptr<float>();
    float* const dscale = of_scale.data_ptr<float>();
    float* const dshift = of_shift.data_ptr<float>();
#pragma omp parallel for num_threads(torch::get_num_threads())
    for (std::int64_t c = 0; c < channels; ++c) {
      const float* const in = x + c * count;
      const float* const back = dy + c * count;
      const float m = means[c], inverse = inverses[c], scale = scales[c], shift = shifts[c];
      const auto normal = [&](std::int64_t k) { return (in[k] - m) * inverse; };
      // Before the activation.
      const auto slope_at = [&](std::int64_t k) {
        return scale * normal(k) + shift > 0 ? back[k] : leak * back[k];
      };
      const auto [sum, product] = sums_of(count, slope_at, normal);
      dshift[c] = static_cast<float>(sum);
      dscale[c] = static_cast<float>(product);
      const auto n = static_cast<double>(count);
      const auto level = static_cast<float>(sum / n), lean = static_cast<float>(product / n);
      const float factor = scale * inverse;
      float* const out = dx + c * count;
#pragma omp simd
      for (std::int64_t k = 0; k < count; ++k) {
        out[k] = factor * (slope_at(k) - level - normal(k) * lean);
      }
    }
    return {of_volume, of_scale, of_shift, {}, {}};
  }
};

}  // namespace

torch::Tensor normalised_activation(const torch::Tensor& volume, const torch::Tensor& scale,
                                    const torch::Tensor& shift, double epsilon, double slope) {
  if (volume.is_cpu()) return NormalisedActivation::apply(volume, scale, shift, epsilon, slope);
  return torch::leaky_relu(
      torch::batch_norm(volume, scale, shift, {}, {}, /*training=*/true, /*momentum=*/0, epsilon,
                        /*cudnn_enabled=*/true),
      slope);
}

}  // namespace fracbench::training
