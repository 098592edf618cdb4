#include "training/convolution_check.h"

#include <torch/torch.h>

#include <cstdint>

namespace fracbench::training {

namespace {

constexpr double kTolerance = 1e-3;
constexpr std::int64_t kSide = 4;

torch::Tensor waves(torch::IntArrayRef shape, double frequency) {
  std::int64_t count = 1;
  for (const std::int64_t side : shape) count *= side;
  return torch::sin(frequency * torch::arange(count, torch::kFloat32)).reshape(shape);
}

/// Not for values that are not a number, either.
bool same(const torch::Tensor& single, const torch::Tensor& exact) {
  return (single - exact).abs().max().item<double>() <
         kTolerance * exact.abs().max().item<double>();
}

}  // namespace

bool convolutions_are_right() {
  const torch::NoGradGuard none;
  for (const std::int64_t channels : {1, 4, 24}) {
    for (const std::int64_t others : {3, 8}) {
      // The weights of a convolution from `channels` to `others`, and of a transposed one back,
      // which is the convolution's derivative by its input.
      const torch::Tensor weight = waves({others, channels, 4, 4, 4}, 1.3),
                          volume = waves({1, channels, kSide, kSide, kSide}, 0.7),
                          back = waves({1, others, kSide, kSide, kSide}, 0.7);
      const torch::Tensor exact = weight.to(torch::kFloat64);
      if (!same(torch::conv3d(volume, weight, {}, 2, 1),
                torch::conv3d(volume.to(torch::kFloat64), exact, {}, 2, 1)) ||
          !same(torch::conv_transpose3d(back, weight, {}, 2, 1),
                torch::conv_transpose3d(back.to(torch::kFloat64), exact, {}, 2, 1))) {
        return false;
      }
    }
  }
  return true;
}

void use_right_convolutions() {
  if (!convolutions_are_right()) at::globalContext().setUserEnabledMkldnn(false);
}

}  // namespace fracbench::training
