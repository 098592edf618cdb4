// Training on another device than the processor: everything that a step touches has to lie there,
// and the operations which any device has are to give what those for the processor alone do.

#include <gtest/gtest.h>
#include <torch/torch.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>

#include "core/error.h"
#include "tests/neural/made_up_data.h"
#include "tests/training/other_device.h"
#include "training/training.h"

namespace fracbench::training {
namespace {

namespace fs = std::filesystem;
using neural::DataSet;
using neural::Decoder;
using neural::Model;
using neural::Normalisation;
using neural::Statistics;
using test::kOtherDevice;

struct Case {
  std::string name;
  TrainingOptions options;
};

Case with(std::string name, const auto& change) {
  Case changed{.name = std::move(name),
               .options = {.network = {.resolutions = {32}, .width = 1.0 / 32}, .epochs = 3}};
  change(changed.options);
  return changed;
}

std::vector<Case> cases() {
  return {
      with("of_the_sample",
           [](auto& o) {
             o.network.resolutions = {32, 64};
           }),
      with("running", [](auto& o) { o.network.statistics = Statistics::running; }),
      with("reestimated", [](auto& o) { o.network.statistics = Statistics::reestimated; }),
      with("groups", [](auto& o) { o.network.normalisation = Normalisation::group; }),
      with("dice", [](auto& o) { o.loss = Loss::dice; }),
      with("eikonal", [](auto& o) { o.loss = Loss::eikonal; }),
      with("random_codes", [](auto& o) { o.segment_codes = SegmentCodes::random; }),
      with("implicit", [](auto& o) { o.network.decoder = Decoder::implicit; }),
      with("pix2pix", [](auto& o) { o.network.decoder = Decoder::pix2pix; }),
  };
}

class DeviceTest : public ::testing::TestWithParam<Case> {
 protected:
  const TrainingOptions& options_ = GetParam().options;
  const DataSet data_ = test::made_up_data(3, {32, 64});
};

INSTANTIATE_TEST_SUITE_P(Kinds, DeviceTest, ::testing::ValuesIn(cases()),
                         [](const auto& p) { return p.param.name; });

/// In the first epochs; rounding alone makes more of a difference with every step of Adam, for
/// which a slope of nearly zero may be of either sign.
void expect_same_losses(const Model& model, const Model& expected, double tolerance) {
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(model.epochs.at(k).loss / expected.epochs.at(k).loss, 1, tolerance)
        << "epoch " << k;
  }
}

TEST_P(DeviceTest, LearnsWhatTheProcessorLearns) {
  const Model expected = train(data_, options_, {});
  const Model model = train(data_, options_, {.device = kOtherDevice});
  expect_same_losses(model, expected, 1e-4);  // sums in another order: seen are 8e-6
  EXPECT_EQ(model.codebook_pattern, expected.codebook_pattern);
  if (!torch::cuda::is_available()) return;
  expect_same_losses(train(data_, options_, {.device = "cuda"}), expected,
                     1e-2);  // its convolutions round to eleven bits
}

TEST_P(DeviceTest, GoesOnWhereItStopped) {
  const fs::path folder =
      fs::temp_directory_path() / ("device-" + GetParam().name + std::to_string(::getpid()));
  std::stop_source source;
  const auto stop = [&](int epoch, double, double) {
    if (epoch == 2) source.request_stop();
  };
  EXPECT_THROW(train(data_, options_,
                     {.device = kOtherDevice,
                      .checkpoints = folder,
                      .stop = source.get_token(),
                      .progress = stop}),
               Cancelled);
  const Model resumed = train(data_, options_, {.device = kOtherDevice, .checkpoints = folder});
  fs::remove_all(folder);
  const Model whole = train(data_, options_, {.device = kOtherDevice});
  EXPECT_EQ(resumed.weights, whole.weights);
  EXPECT_EQ(resumed.statistics, whole.statistics);
  EXPECT_EQ(resumed.epochs.back().loss, whole.epochs.back().loss);
}

// Without this, the tests above would show nothing.
TEST(OtherDevice, RefusesTensorsOfTheProcessor) {
  const torch::Tensor here = torch::ones({3}, torch::Device(kOtherDevice)),
                      there = torch::ones({3});
  EXPECT_THROW(here + there, c10::Error);
  EXPECT_THROW(torch::cat({here, there}), c10::Error);
  EXPECT_THROW(there.to(here.device()).dot(there), c10::Error);
  EXPECT_EQ((here * 2 + here).sum().item<float>(), 9);
}

}  // namespace
}  // namespace fracbench::training
