#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <stop_token>
#include <string>
#include <string_view>

#include "neural/data_set.h"
#include "neural/model.h"
#include "neural/network_options.h"

namespace fracbench::training {

/// What is made small. All compare the output with the GS-SDF voxel by voxel, over all resolutions.
enum class Loss : std::uint8_t {
  l2,       ///< mean squared error, equation (5) of the paper
  eikonal,  ///< l2 + 0.1 mean (|grad f| - 1)^2
  dice,     ///< 1 - Dice coefficient of the insides, f > 0, with a soft edge one voxel wide
};

/// What follows the code of the impulse in a training step.
enum class SegmentCodes : std::uint8_t {
  trained,  ///< a row of each pattern's own, trained like a weight
  random,   ///< drawn anew at every step: the paper's ablation "w/o segment code"
};

/// How a network is trained. Defaults are the paper's (section 6.2).
struct TrainingOptions {
  neural::NetworkOptions network;
  int epochs = 1000;
  double learning_rate = 0.003;
  int later_from = 400;        ///< epoch from which on the later rate holds
  double later_rate = 0.0005;  ///< (the supplement says 0.00005)
  int codebook_rows = 0;       ///< N_space, of each shape; 0: one for each pattern
  Loss loss = Loss::l2;
  SegmentCodes segment_codes = SegmentCodes::trained;
  double stable_loss = 0;  ///< stop after an epoch with a lower loss; 0: never
  std::uint64_t seed = 1;
};

/// What does not change what is learned, but for rounding.
struct TrainingRun {
  int threads = 1;
  std::string device = "cpu";              ///< libtorch's name: "cpu", "cuda", "cuda:1" ...
  std::filesystem::path checkpoints = {};  ///< folder; empty: none are written
  std::stop_token stop = {};
  /// Told after each epoch: how many are done, its loss, and seconds that are left.
  std::function<void(int epoch, double loss, double seconds_left)> progress = {};
};

/// A loss was not a number. The check point of the last good epoch is kept.
class TrainingFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Trains with Adam and batches of one, all patterns once an epoch in an order that the seed gives.
/// With a folder for check points it goes on after the last epoch that is there, and ends in the
/// same bytes on one processor with as many threads as a training that was never interrupted.
/// Throws InputError for options and data that do not fit, a device that is not there and check
/// points of another training; TrainingFailure; Cancelled when asked to stop.
neural::Model train(const neural::DataSet& data, const TrainingOptions& options,
                    const TrainingRun& run);

/// The loss (l2) of each pattern, decoded from its own code with the model as it predicts.
std::vector<double> pattern_losses(const neural::Model& model, const neural::DataSet& data,
                                   int threads);

std::string_view to_string(Loss value);
std::string_view to_string(SegmentCodes value);
nlohmann::ordered_json to_json(const TrainingOptions& options);
/// The other way round. Throws InputError, also for values out of range.
TrainingOptions training_options_from_json(const nlohmann::ordered_json& json);

}  // namespace fracbench::training
