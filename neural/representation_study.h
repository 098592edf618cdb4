#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace fracbench::neural {

/// What stands for a divided image: supplement, section 6 and figure 7 of the DeepFracture paper.
enum class Representation : std::uint8_t {
  labels,    ///< a value for each region, in random order; Dice loss
  lines,     ///< 1 on the borders, else 0; L2 loss
  distance,  ///< unsigned distance to the nearest border; L2 loss
};

inline constexpr std::array kRepresentations = {Representation::labels, Representation::lines,
                                                Representation::distance};

std::string_view to_string(Representation value);

/// Everything that determines the outcome.
struct StudySettings {
  int side = 64;      ///< pixels
  int patterns = 32;  ///< Voronoi diagrams, which the network learns by heart
  int least_sites = 6, most_sites = 14;
  int epochs = 150;
  double learning_rate = 0.003;
  std::uint64_t seed = 1;

  bool operator==(const StudySettings&) const = default;
};

nlohmann::ordered_json to_json(const StudySettings& settings);

/// How well one representation was learned. Lists by pattern, images one after the other.
struct StudyOutcome {
  Representation representation = Representation::labels;
  std::vector<double> loss = {};        ///< mean of each epoch, of its own kind
  std::vector<double> agreement = {};   ///< adjusted Rand index of the regions that come back
  std::vector<double> ceiling = {};     ///< the same from exact images
  std::vector<double> regions = {};     ///< how many come back
  std::vector<float> targets = {};      ///< side x side values in [0, 1], row by row
  std::vector<float> decoded = {};      ///< the same, as learned
  std::vector<std::int32_t> back = {};  ///< region of each pixel, read from `decoded`; 0, 1, 2, ...

  bool operator==(const StudyOutcome&) const = default;
};

/// The same diagrams in all representations.
struct RepresentationStudy {
  StudySettings settings = {};
  std::vector<double> true_regions = {};  ///< of each pattern
  std::vector<StudyOutcome> outcomes = {};

  bool operator==(const RepresentationStudy&) const = default;
};

/// One file (core/array_file.h, packed). Throws InputError.
void write_representation_study(const std::filesystem::path& file,
                                const RepresentationStudy& study);

/// The folder of the check points that outlive an interruption of the study that makes this file.
std::filesystem::path study_checkpoints(const std::filesystem::path& file);
/// Removes it, with whatever killed processes left in it.
void remove_study_checkpoints(const std::filesystem::path& file);

/// Throws InputError where the file cannot be read, is damaged, or its numbers do not fit together.
RepresentationStudy read_representation_study(const std::filesystem::path& file);

}  // namespace fracbench::neural
