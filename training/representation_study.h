#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "neural/representation_study.h"

namespace fracbench::training {

struct StudyRun {
  int threads = 1;
  std::filesystem::path checkpoints = {};  ///< folder; empty: none are written
  std::stop_token stop = {};
  /// Told of each epoch that is learned, counted over all representations, one after the other.
  std::function<void(int epoch, double loss)> progress = {};
  /// Told of check points that cannot be used: the representation begins anew.
  std::function<void(std::string_view)> message = {};
};

/// Trains one small decoder (a trainable code for each pattern, a linear layer to 8 x 8, transposed
/// convolutions in 2D) for each representation of the same Voronoi diagrams, and reads the regions
/// back from what it decodes. With a folder for check points, one for each representation, it goes
/// on after the last epoch that is there, and ends in the same bytes on one processor with as many
/// threads as a study that was never interrupted. Throws InputError for settings out of range and
/// check points that cannot be written, Cancelled.
neural::RepresentationStudy study_representations(const neural::StudySettings& settings,
                                                  const StudyRun& run = {});

/// How many epochs of each representation are not in the check points yet; all, where there are
/// none. Throws InputError for settings out of range.
std::vector<int> study_epochs_left(const neural::StudySettings& settings, const StudyRun& run);

}  // namespace fracbench::training
