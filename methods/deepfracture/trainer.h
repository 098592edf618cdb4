#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/context.h"
#include "methods/method.h"
#include "neural/model.h"

namespace fracbench::deepfracture {

struct TrainerCall {
  std::filesystem::path data_set;     ///< neural::write_data_set
  std::filesystem::path model;        ///< to be written
  std::filesystem::path checkpoints;  ///< folder
  std::string options;                ///< JSON of training::TrainingOptions
};

/// Trains in a process of its own, which ends when it is to stop (Cancelled) and reports through
/// context.progress; uses context.threads and context.device. Throws InputError for what the
/// program refuses, MethodFailure where it fails otherwise, with what it said.
void run_trainer(const TrainerCall& call, const Context& context);

/// Seconds that training with these options takes on so many patterns, measured on a few steps.
double training_seconds(const std::string& options, std::size_t patterns,
                        const TrainingMachine& machine);

}  // namespace fracbench::deepfracture
