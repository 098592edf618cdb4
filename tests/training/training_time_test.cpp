#include "training/training_time.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "neural/operations.h"
#include "tests/neural/made_up_data.h"

namespace fracbench::training {
namespace {

using neural::Decoder;

TEST(TrainingTime, IsThatOfATrainingInTheSameProcess) {
  for (const Decoder decoder : {Decoder::voxel, Decoder::implicit, Decoder::pix2pix}) {
    const TrainingOptions options{
        .network = {.resolutions = {32}, .width = 1.0 / 16, .decoder = decoder}, .epochs = 4};
    const double told = seconds_per_step(options, {});
    const neural::DataSet data = test::made_up_data(8, {32});
    const neural::Model model = train(data, options, {});
    double measured = model.epochs.back().seconds;
    for (const auto& epoch : model.epochs) measured = std::min(measured, epoch.seconds);
    // Other work on the machine may slow down either of them.
    const double ratio = told * 8 / measured;
    EXPECT_GT(ratio, 0.25) << to_string(decoder);
    EXPECT_LT(ratio, 4) << to_string(decoder);
  }
}

TEST(TrainingTime, GrowsWithTheWork) {
  const auto work = [](std::vector<int> resolutions, Decoder decoder) {
    return neural::training_work({.resolutions = std::move(resolutions), .decoder = decoder});
  };
  // A block has half the channels of the one before it, in and out, and eight times its voxels:
  // twice the operations. Three blocks are 7 / 3 of two; the last layer adds little.
  EXPECT_NEAR(work({128}, Decoder::voxel) / work({64}, Decoder::voxel), 7.0 / 3, 0.1);
  EXPECT_GT(work({64, 128}, Decoder::voxel), work({128}, Decoder::voxel));
  EXPECT_EQ(work({128}, Decoder::implicit), work({32}, Decoder::implicit));
  EXPECT_EQ(work({128}, Decoder::pix2pix), 8 * work({64}, Decoder::pix2pix));
}

TEST(TrainingTime, RefusesWhatTrainingRefuses) {
  EXPECT_ANY_THROW(seconds_per_step({.network = {.resolutions = {48}}}, {}));
  EXPECT_ANY_THROW(seconds_per_step({.network = {.resolutions = {32}}}, {.device = "tpu"}));
}

TEST(TrainingTime, OfAStudyIsThatOfMakingIt) {
  using Clock = std::chrono::steady_clock;
  const neural::StudySettings settings{.side = 32, .patterns = 16, .epochs = 20};
  // Other work on the machine may slow down either of them, though hardly at every attempt.
  bool alike = false;
  for (int attempt = 0; attempt < 5 && !alike; ++attempt) {
    const double told = study_seconds(settings, {});
    const auto start = Clock::now();
    study_representations(settings);
    const std::chrono::duration<double> measured = Clock::now() - start;
    alike = told > measured.count() / 4 && told < measured.count() * 4;
  }
  EXPECT_TRUE(alike);
  EXPECT_ANY_THROW(study_seconds({.side = 48}, {}));
}

}  // namespace
}  // namespace fracbench::training
