#include "training/adam.h"

#include <gtest/gtest.h>
#include <torch/torch.h>

namespace fracbench::training {
namespace {

// On the processor a step is one loop of our own. The tolerance is that of twenty steps of size
// 0.01, each rounded to single precision.
TEST(Adam, TakesTheStepsOfLibtorchsOwn) {
  const torch::Tensor start = torch::sin(torch::arange(1000, torch::kFloat32)).reshape({10, 100});
  torch::Tensor ours = start.clone().requires_grad_(), theirs = start.clone().requires_grad_();
  Adam adam({{"x", ours}});
  torch::optim::Adam reference({theirs}, torch::optim::AdamOptions(0.01));
  const auto objective = [](const torch::Tensor& x) { return (x - 0.3).pow(4).sum(); };
  for (int step = 0; step < 20; ++step) {
    objective(ours).backward();
    adam.step(0.01);
    reference.zero_grad();
    objective(theirs).backward();
    reference.step();
  }
  EXPECT_EQ(adam.steps, 20);
  EXPECT_LT((ours - theirs).abs().max().item<double>(), 2e-6);
  EXPECT_GT((ours - start).abs().mean().item<double>(), 0.1);
  EXPECT_FALSE(ours.grad().defined() && ours.grad().abs().sum().item<double>() > 0);
}

}  // namespace
}  // namespace fracbench::training
