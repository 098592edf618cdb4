#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace fracbench::training {

/// What stands for a divided image: supplement, section 6 and figure 7 of the DeepFracture paper.
enum class Representation : std::uint8_t {
  labels,    ///< a value for each region, in random order; Dice loss
  lines,     ///< 1 on the borders, else 0; L2 loss
  distance,  ///< unsigned distance to the nearest border; L2 loss
};

std::string_view to_string(Representation value);

struct StudyOptions {
  int side = 64;      ///< pixels
  int patterns = 32;  ///< Voronoi diagrams, which the network learns by heart
  int least_sites = 6, most_sites = 14;
  int epochs = 200;
  double learning_rate = 0.003;
  std::uint64_t seed = 1;
  int threads = 1;
  std::stop_token stop = {};
  std::function<void(std::string_view what, double fraction)> progress = {};
};

/// How well one representation was learned, over all patterns.
struct StudyResult {
  Representation representation = Representation::labels;
  double loss = 0;             ///< at the end, of its own kind
  double agreement = 0;        ///< adjusted Rand index of the regions that come back, mean
  double ceiling = 0;          ///< the same from exact images
  double regions = 0;          ///< that come back, mean
  double true_regions = 0;     ///< that there are, mean
  std::vector<float> targets;  ///< side x side images, one after the other, in [0, 1]
  std::vector<float> decoded;
};

/// Trains one small decoder (a trainable code for each pattern, a linear layer to 8 x 8, transposed
/// convolutions in 2D) for each representation of the same Voronoi diagrams, and reads the regions
/// back from what it decodes. Throws Cancelled.
std::vector<StudyResult> study_representations(const StudyOptions& options);

}  // namespace fracbench::training
