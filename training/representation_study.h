#pragma once

#include <functional>
#include <stop_token>

#include "neural/representation_study.h"

namespace fracbench::training {

struct StudyRun {
  int threads = 1;
  std::stop_token stop = {};
  /// Told of each epoch, counted over all representations, one after the other.
  std::function<void(int epoch, double loss)> progress = {};
};

/// Trains one small decoder (a trainable code for each pattern, a linear layer to 8 x 8, transposed
/// convolutions in 2D) for each representation of the same Voronoi diagrams, and reads the regions
/// back from what it decodes. Throws InputError for settings out of range, Cancelled.
neural::RepresentationStudy study_representations(const neural::StudySettings& settings,
                                                  const StudyRun& run = {});

}  // namespace fracbench::training
