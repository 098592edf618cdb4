#include "training/training_time.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "core/impulse_vector.h"
#include "core/voxel_grid.h"
#include "neural/operations.h"

namespace fracbench::training {

namespace {

constexpr int kFinest = 64;
// An epoch this long is told from the clock's and the scheduler's own times.
constexpr double kLongEnough = 0.25;  // s
constexpr std::size_t kMostPatterns = 256;
constexpr int kTimedEpochs = 3;  // the first is slower than those that follow
// Diagrams that tell how many of them make an epoch of a study that is long enough.
constexpr int kFewDiagrams = 4;

/// Balls of many sizes.
neural::DataSet made_up_data(const neural::NetworkOptions& network, std::size_t patterns) {
  neural::DataSet data;
  data.shapes = {{.name = "made up", .digest = "made up", .scaling = {}}};
  data.features = network.features;
  for (std::size_t k = 0; k < patterns; ++k) {
    neural::Pattern pattern;
    pattern.name = "ball";
    pattern.impulses.assign(kImpulseValues * static_cast<std::size_t>(network.features), 0.5f);
    const double radius =
        0.2 + 0.7 * static_cast<double>(k + 1) / static_cast<double>(patterns + 1);
    for (const int r : network.resolutions) {
      VoxelGrid<float> field = unit_grid<float>(r);
      for (int z = 0; z < r; ++z) {
        for (int y = 0; y < r; ++y) {
          for (int x = 0; x < r; ++x) {
            field.at(x, y, z) = static_cast<float>(radius - field.position(x, y, z).norm());
          }
        }
      }
      pattern.fields[r] = std::move(field.values);
    }
    data.patterns.push_back(std::move(pattern));
  }
  return data;
}

/// Seconds of a step of each representation, from `patterns` diagrams. The mean: other work on the
/// machine, which slows down these steps, will slow down the study, too.
std::vector<double> seconds_per_image(neural::StudySettings settings, int patterns,
                                      const StudyRun& run) {
  using Clock = std::chrono::steady_clock;
  settings.patterns = patterns;
  settings.epochs = kTimedEpochs;
  std::vector<Clock::time_point> ends;
  study_representations(settings, {.threads = run.threads,
                                   .stop = run.stop,
                                   .progress = [&](int, double) { ends.push_back(Clock::now()); }});
  std::vector<double> seconds;
  for (std::size_t last = kTimedEpochs - 1; last < ends.size(); last += kTimedEpochs) {
    const Clock::duration later = ends[last] - ends[last - kTimedEpochs + 1];
    seconds.push_back(std::chrono::duration<double>(later).count() /
                      ((kTimedEpochs - 1) * patterns));
  }
  return seconds;
}

}  // namespace

double seconds_per_step(const TrainingOptions& options, const TrainingRun& run) {
  TrainingOptions coarse = options;
  std::vector<int>& resolutions = coarse.network.resolutions;
  std::erase_if(resolutions, [](int r) { return r > kFinest; });
  if (resolutions.empty()) resolutions = {kFinest};
  const double scale =
      neural::training_work(options.network) / neural::training_work(coarse.network);
  coarse.epochs = kTimedEpochs;
  coarse.stable_loss = 0;
  TrainingRun unseen = run;
  unseen.checkpoints.clear();
  unseen.progress = {};
  for (std::size_t patterns = 1;;) {
    const neural::Model model = train(made_up_data(coarse.network, patterns), coarse, unseen);
    const double epoch = std::min(model.epochs[1].seconds, model.epochs[2].seconds);
    if (epoch > kLongEnough || patterns >= kMostPatterns) {
      return scale * epoch / static_cast<double>(patterns);
    }
    // As many as should do, where so short a time tells that.
    const double growth = std::clamp(1.2 * kLongEnough / epoch, 1.2, 16.0);
    patterns = static_cast<std::size_t>(std::ceil(growth * static_cast<double>(patterns)));
  }
}

double study_seconds(const neural::StudySettings& settings, const StudyRun& run) {
  const std::vector<int> left = study_epochs_left(settings, run);
  if (std::ranges::count(left, 0) == std::ssize(left)) return 0;
  std::vector<double> step = seconds_per_image(settings, kFewDiagrams, run);
  const double wanted = std::ceil(kLongEnough / *std::ranges::min_element(step));
  const auto patterns = static_cast<int>(std::min<double>(wanted, kMostPatterns));
  if (patterns > kFewDiagrams) step = seconds_per_image(settings, patterns, run);
  double seconds = 0;
  for (std::size_t k = 0; k < step.size(); ++k) seconds += step[k] * left[k] * settings.patterns;
  return seconds;
}

}  // namespace fracbench::training
