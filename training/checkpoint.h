#pragma once

#include <torch/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "neural/model.h"

namespace fracbench::training {

/// How far a training has come.
struct TrainingState {
  std::string training;  ///< digest of data set and options
  std::int64_t steps = 0;
  std::vector<neural::EpochRecord> epochs;
};

/// A training between two epochs.
struct Checkpoint {
  TrainingState state;
  /// Weights, segment codes and statistics by name; "first/..." and "second/..." hold the moments
  /// of Adam of what is trained.
  std::map<std::string, std::vector<float>> arrays;
};

/// Replaces the check point of a folder, with the numbers of these tensors on any device; it is
/// there whole at any moment. Throws InputError.
void write_checkpoint(const std::filesystem::path& folder, const TrainingState& state,
                      const std::map<std::string, torch::Tensor>& tensors);

/// None where the folder has none. Throws InputError where it is damaged; of which training it is
/// is for the caller to look at.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder);

/// The file in a folder.
std::filesystem::path checkpoint_file(const std::filesystem::path& folder);

/// Gives tensors, on any device, the numbers that a check point has for them. Throws InputError,
/// before anything is changed, where one is missing or of another size.
void put_arrays(const Checkpoint& from, std::map<std::string, torch::Tensor> tensors);

}  // namespace fracbench::training
