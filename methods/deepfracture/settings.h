#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "core/options.h"
#include "methods/deepfracture/reconstruct.h"
#include "neural/network_options.h"

namespace fracbench::deepfracture {

/// What the options of the method ask for.
struct Settings {
  neural::NetworkOptions network;
  nlohmann::ordered_json training() const;  ///< options of fracbench-train, with this seed
  int resolution = 128;                     ///< of the output that is cut
  double truncation = 0;                    ///< of the fields to learn from, m; 0: none
  int least_patterns = 2;
  bool quantise = true;         ///< decode the nearest row of the codebook, else the code itself
  std::filesystem::path model;  ///< trained elsewhere; empty: train
  ReconstructOptions reconstruct;

  // What only the training needs.
  int epochs = 1000;
  double learning_rate = 0.003, later_rate = 0.0005;
  int later_from = 400, codebook_rows = 0;
  std::string loss = "l2", segment_codes = "trained";
  double stable_loss = 0;
  std::uint64_t seed = 1;
};

OptionsSchema options_schema();

/// Throws InputError where values do not fit together.
Settings settings_from(const Options& options);

}  // namespace fracbench::deepfracture
