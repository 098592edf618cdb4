#include <gtest/gtest.h>
#include <torch/torch.h>

#include <functional>
#include <vector>

#include "training/normalised_activation.h"
#include "training/transposed_convolution.h"

namespace fracbench::training {
namespace {

using Operation = std::function<torch::Tensor(const std::vector<torch::Tensor>&)>;

/// The result and the gradients with respect to all inputs of a sum that weighs each value
/// differently.
std::vector<torch::Tensor> with_gradients(const Operation& operation,
                                          const std::vector<torch::Tensor>& inputs) {
  std::vector<torch::Tensor> own;
  for (const torch::Tensor& input : inputs) own.push_back(input.detach().clone().requires_grad_());
  const torch::Tensor result = operation(own);
  (result * torch::sin(torch::arange(result.numel(), torch::kFloat32)).reshape(result.sizes()))
      .sum()
      .backward();
  std::vector<torch::Tensor> all = {result.detach()};
  for (const torch::Tensor& input : own) all.push_back(input.grad());
  return all;
}

void expect_same(const Operation& ours, const Operation& libtorch,
                 const std::vector<torch::Tensor>& inputs, double tolerance) {
  for (const int threads : {1, 2}) {
    torch::set_num_threads(threads);
    const auto a = with_gradients(ours, inputs), b = with_gradients(libtorch, inputs);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      ASSERT_EQ(a[k].sizes(), b[k].sizes()) << k;
      const double scale = b[k].abs().max().item<double>();
      EXPECT_LT((a[k] - b[k]).abs().max().item<double>(), tolerance * scale) << k;
    }
  }
}

torch::Tensor waves(torch::IntArrayRef shape, double frequency) {
  std::int64_t count = 1;
  for (const std::int64_t side : shape) count *= side;
  return torch::sin(frequency * torch::arange(count, torch::kFloat32)).reshape(shape);
}

TEST(TransposedConvolution, AndItsGradientsAreThoseOfLibtorch) {
  const Operation ours = [](const auto& in) { return transposed_convolution(in[0], in[1]); };
  // In double precision, for which libtorch does not call oneDNN: see convolution_check.h.
  const Operation libtorch = [](const auto& in) {
    return torch::conv_transpose3d(in[0].to(torch::kFloat64), in[1].to(torch::kFloat64), {}, 2, 1)
        .to(torch::kFloat32);
  };
  for (const std::int64_t side : {1, 2, 5}) {
    // Single precision sums of a hundred or so products in another order.
    expect_same(ours, libtorch, {waves({1, 3, side, side, side}, 0.7), waves({3, 4, 4, 4, 4}, 1.3)},
                1e-5);
  }
}

TEST(NormalisedActivation, AndItsGradientsAreThoseOfLibtorch) {
  constexpr double kEpsilon = 1e-5, kSlope = 0.2;
  const Operation ours = [&](const auto& in) {
    return normalised_activation(in[0], in[1], in[2], kEpsilon, kSlope);
  };
  const Operation libtorch = [&](const auto& in) {
    return torch::leaky_relu(
        torch::batch_norm(in[0], in[1], in[2], {}, {}, true, 0, kEpsilon, false), kSlope);
  };
  const torch::Tensor scale = torch::tensor({1.0f, -0.5f, 2.0f}),
                      shift = torch::tensor({0.0f, 0.3f, -1.0f});
  for (const std::int64_t side : {2, 13}) {
    // Far from zero, where a variance from the mean of squares would lose its digits.
    expect_same(ours, libtorch, {10 + waves({1, 3, side, side, side}, 0.7), scale, shift}, 1e-4);
  }
}

TEST(NormalisedActivation, IsTheSameForAnyNumberOfThreads) {
  const torch::Tensor volume = waves({1, 5, 12, 12, 12}, 0.3), ones = torch::ones({5}),
                      zeros = torch::zeros({5});
  const Operation ours = [](const auto& in) {
    return normalised_activation(in[0], in[1], in[2], 1e-5, 0.2);
  };
  torch::set_num_threads(1);
  const auto one = with_gradients(ours, {volume, ones, zeros});
  torch::set_num_threads(2);
  const auto two = with_gradients(ours, {volume, ones, zeros});
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_TRUE(torch::equal(one[k], two[k])) << k;
}

}  // namespace
}  // namespace fracbench::training
