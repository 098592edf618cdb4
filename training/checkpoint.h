#pragma once

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

/// None where the folder has none. Throws InputError where it is damaged or of another training.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder,
                                          const std::string& training);

}  // namespace fracbench::training
