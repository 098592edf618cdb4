#pragma once

#include <torch/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "neural/model.h"

namespace fracbench::training {

/// The state of a training between two epochs.
struct Checkpoint {
  std::string training;  ///< digest of data set and options
  std::int64_t steps = 0;
  std::vector<neural::EpochRecord> epochs;
  /// Weights, segment codes and statistics by name; "first/..." and "second/..." hold the moments
  /// of Adam of what is trained.
  std::map<std::string, std::vector<float>> arrays;
};

/// Replaces the check point of a folder; it is there whole at any moment. Throws InputError.
void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& state);

/// None where the folder has none. Throws InputError where it is damaged; of which training it is
/// is for the caller to look at.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder);

/// The file in a folder.
std::filesystem::path checkpoint_file(const std::filesystem::path& folder);

/// The numbers of tensors, as a check point has them.
std::map<std::string, std::vector<float>> arrays_of(
    const std::map<std::string, torch::Tensor>& tensors);

/// Gives tensors, on any device, the numbers that a check point has for them. Throws InputError,
/// before anything is changed, where one is missing or of another size.
void put_arrays(const Checkpoint& state, std::map<std::string, torch::Tensor> tensors);

}  // namespace fracbench::training
