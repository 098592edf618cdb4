#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace fracbench::neural {

/// The program fracbench-train: what FRACBENCH_TRAINER names, or beside the running program. Throws
/// InputError where it is not there, with the way out.
std::filesystem::path training_program();

struct TrainingWatch {
  std::stop_token stop = {};
  /// Told of each epoch: how much of the training is done, in [0, 1], and the epoch's loss.
  std::function<void(double fraction, double loss)> on_epoch = {};
  /// Told of the seconds that the program says when it is asked for the time.
  std::function<void(double seconds)> on_seconds = {};
  /// Told what the program has to say on the way, such as of a check point that is damaged.
  std::function<void(std::string_view text)> on_message = {};
};

/// Calls it with these arguments and those that make it tell of each epoch; it ends with this call,
/// and when asked to stop (Cancelled). Throws InputError for what the program refuses,
/// MethodFailure where it fails otherwise, with what it said; messages begin with `whose`.
void run_training_program(std::vector<std::string> arguments, std::string_view whose,
                          const TrainingWatch& watch);

}  // namespace fracbench::neural
