#include "training/convolution_check.h"

#include <gtest/gtest.h>
#include <torch/torch.h>

namespace fracbench::training {
namespace {

TEST(Convolutions, AreRightOnceCheckedWhateverLibtorchThereIs) {
  use_right_convolutions();
  EXPECT_TRUE(convolutions_are_right());
}

TEST(Convolutions, KeepOneDnnWhereItIsRight) {
  const bool enabled = at::globalContext().userEnabledMkldnn(), right = convolutions_are_right();
  use_right_convolutions();
  EXPECT_EQ(at::globalContext().userEnabledMkldnn(), enabled && right);
}

}  // namespace
}  // namespace fracbench::training
