#include "training/representation_study.h"

#include <fmt/format.h>
#include <torch/torch.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <deque>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "core/adjusted_rand_index.h"
#include "core/digest.h"
#include "core/error.h"
#include "core/random.h"
#include "training/adam.h"
#include "training/checkpoint.h"
#include "training/convolution_check.h"
#include "training/divided_image.h"
#include "training/network.h"

namespace fracbench::training {

namespace {

using Clock = std::chrono::steady_clock;
using neural::EpochRecord;
using neural::Representation;
using neural::StudyOutcome;
using neural::StudySettings;

constexpr int kCode = 32, kBase = 8, kChannels = 64;
constexpr double kSlope = 0.2, kEpsilon = 1e-5;
// Part of what a check point is of; to be changed with anything that changes what is learned.
constexpr std::string_view kAlgorithm = "representation study 1";
// A check point is written once the training since the last one took this many times as long as
// writing that did: check points take 5 % of the time, on a slow disk, too.
constexpr int kTrainingPerCheckPoint = 20;

void stop_if_asked(const StudyRun& run) {
  if (run.stop.stop_requested()) throw Cancelled();
}

/// A decoder of images from a trainable code for each pattern.
class ImageNetwork {
 public:
  ImageNetwork(const StudySettings& o, Random& random) {
    std::vector<neural::WeightSpec> specs = {{"linear.weight", {kChannels * kBase * kBase, kCode}},
                                             {"linear.bias", {kChannels * kBase * kBase}}};
    int channels = kChannels;
    for (int side = kBase; side < o.side; side *= 2, ++blocks_) {
      const std::string name = "block" + std::to_string(blocks_);
      const int to = channels / 2;
      specs.push_back({name + ".weight", {channels, to, 4, 4}});
      specs.push_back({name + ".bias", {to}});
      specs.push_back({name + ".scale", {to}});
      specs.push_back({name + ".shift", {to}});
      channels = to;
    }
    specs.push_back({"head.weight", {1, channels, 3, 3}});
    specs.push_back({"head.bias", {1}});
    weights_ = initial_weights(specs, random, torch::kCPU);
    std::vector<float> codes;
    for (int n = 0; n < o.patterns * kCode; ++n)
      codes.push_back(static_cast<float>(random.normal()));
    weights_["codes"] = tensor_of(codes, {o.patterns, kCode}).requires_grad_();
  }

  torch::Tensor decode(std::int64_t pattern) {
    torch::Tensor values = torch::leaky_relu(
        torch::mv(weights_["linear.weight"], weights_["codes"][pattern]) + weights_["linear.bias"],
        kSlope);
    values = values.reshape({1, kChannels, kBase, kBase});
    for (int k = 0; k < blocks_; ++k) {
      const std::string name = "block" + std::to_string(k);
      values = torch::conv_transpose2d(values, weights_[name + ".weight"], weights_[name + ".bias"],
                                       2, 1);
      values = torch::leaky_relu(
          torch::batch_norm(values, weights_[name + ".scale"], weights_[name + ".shift"], {}, {},
                            true, 0.1, kEpsilon, false),
          kSlope);
    }
    values = torch::conv2d(values, weights_["head.weight"], weights_["head.bias"], 1, 1);
    return torch::sigmoid(values).flatten();
  }

  TensorMap& weights() { return weights_; }

 private:
  TensorMap weights_;
  int blocks_ = 0;
};

torch::Tensor loss_of(const torch::Tensor& image, const torch::Tensor& target,
                      Representation representation) {
  if (representation != Representation::labels) return torch::mse_loss(image, target);
  return 1 - 2 * (image * target).sum() / (image.square().sum() + target.square().sum());
}

/// The training of one representation: everything that changes in it.
class ImageTraining {
 public:
  /// Goes on from the check point that there is.
  ImageTraining(Representation representation, const StudySettings& settings, const StudyRun& run)
      : representation_(representation),
        settings_(settings),
        run_(run),
        network_(initial_network(representation, settings)),
        adam_(network_.weights()) {
    if (!run.checkpoints.empty()) restore();
  }

  Representation representation() const { return representation_; }
  int epochs_left() const { return settings_.epochs - static_cast<int>(epochs_.size()); }

  /// Learns the targets by heart.
  void learn(const std::vector<torch::Tensor>& targets) {
    while (epochs_left() > 0) {
      const auto start = Clock::now();
      EpochRecord epoch{.loss = one_epoch(targets), .seconds = 0};
      epoch.seconds = std::chrono::duration<double>(Clock::now() - start).count();
      epochs_.push_back(epoch);
      if (!run_.checkpoints.empty()) keep();
      if (run_.progress) {
        run_.progress((1 + static_cast<int>(representation_)) * settings_.epochs - epochs_left(),
                      epoch.loss);
      }
    }
  }

  std::vector<double> losses() const {
    std::vector<double> list;
    for (const EpochRecord& epoch : epochs_) list.push_back(epoch.loss);
    return list;
  }

  std::vector<float> decode(std::size_t pattern) {
    const torch::NoGradGuard none;
    return values_of(network_.decode(static_cast<std::int64_t>(pattern)));
  }

 private:
  static ImageNetwork initial_network(Representation representation, const StudySettings& s) {
    Random random = Random(s.seed).fork(to_string(representation));
    return {s, random};
  }

  /// The mean loss.
  double one_epoch(const std::vector<torch::Tensor>& targets) {
    const bool late = static_cast<int>(epochs_.size()) >= 2 * settings_.epochs / 3;
    double sum = 0;
    for (std::size_t k = 0; k < targets.size(); ++k) {
      stop_if_asked(run_);
      const torch::Tensor loss =
          loss_of(network_.decode(static_cast<std::int64_t>(k)), targets[k], representation_);
      sum += loss.item<double>();
      loss.backward();
      adam_.step(late ? settings_.learning_rate / 6 : settings_.learning_rate);
    }
    return sum / static_cast<double>(targets.size());
  }

  std::filesystem::path folder() const { return run_.checkpoints / to_string(representation_); }

  /// Digest of all that determines the weights after so many epochs.
  std::string id() const {
    Digest digest;
    digest.add(kAlgorithm);
    digest.add(to_json(settings_).dump());
    digest.add(to_string(representation_));
    digest.add(static_cast<std::uint64_t>(run_.threads));
    digest.add(std::string_view(TORCH_VERSION));
    return digest.hex();
  }

  /// All tensors that change, by their name in a check point.
  TensorMap tensors() {
    TensorMap list;
    for (auto& [name, tensor] : network_.weights()) list["weights/" + name] = tensor;
    for (auto& [name, tensor] : adam_.first) list["first/" + name] = tensor;
    for (auto& [name, tensor] : adam_.second) list["second/" + name] = tensor;
    return list;
  }

  void restore() {
    try {
      const auto kept = read_checkpoint(folder());
      if (!kept) return;
      if (kept->state.training != id() ||
          static_cast<int>(kept->state.epochs.size()) > settings_.epochs) {
        throw InputError(
            fmt::format("'{}' is of other settings", checkpoint_file(folder()).string()));
      }
      put_arrays(*kept, tensors());
      adam_.steps = kept->state.steps;
      epochs_ = kept->state.epochs;
    } catch (const InputError& error) {
      if (run_.message) {
        run_.message(fmt::format("{}; {} begin anew", error.what(), to_string(representation_)));
      }
    }
  }

  /// Writes a check point, unless the last one was just now.
  void keep() {
    const auto start = Clock::now();
    if (start < next_check_point_ && epochs_left() > 0) return;
    std::error_code ignored;  // the file that cannot be written tells of it
    std::filesystem::create_directories(folder(), ignored);
    write_checkpoint(folder(), {id(), adam_.steps, epochs_}, tensors());
    const auto end = Clock::now();
    next_check_point_ = end + kTrainingPerCheckPoint * (end - start);
  }

  Representation representation_;
  const StudySettings& settings_;
  const StudyRun& run_;
  ImageNetwork network_;
  Adam adam_;
  std::vector<EpochRecord> epochs_;
  Clock::time_point next_check_point_ = {};
};

StudyOutcome study(const std::vector<Labels>& truth, ImageTraining& training,
                   const StudySettings& s, const StudyRun& run) {
  const Representation representation = training.representation();
  StudyOutcome outcome{.representation = representation};
  std::vector<torch::Tensor> targets;
  for (const Labels& labels : truth) {
    stop_if_asked(run);
    const std::vector<float> image = image_of(labels, representation, s.side);
    targets.push_back(tensor_of(image, {static_cast<std::int64_t>(image.size())}));
    std::ranges::copy(image, std::back_inserter(outcome.targets));
  }
  training.learn(targets);
  outcome.loss = training.losses();
  for (std::size_t k = 0; k < truth.size(); ++k) {
    stop_if_asked(run);
    const int count = 1 + *std::ranges::max_element(truth[k]);
    const std::vector<float> image = training.decode(k);
    const Labels back = regions_of(image, representation, s.side, count);
    const Labels exact = regions_of(values_of(targets[k]), representation, s.side, count);
    outcome.agreement.push_back(adjusted_rand_index(truth[k], back));
    outcome.ceiling.push_back(adjusted_rand_index(truth[k], exact));
    outcome.regions.push_back(count_of(back));
    std::ranges::copy(image, std::back_inserter(outcome.decoded));
    std::ranges::copy(in_order(back), std::back_inserter(outcome.back));
  }
  return outcome;
}

void check(const StudySettings& s) {
  const auto require = [](bool good, std::string_view what) {
    if (!good) throw InputError(fmt::format("the study's {}", what));
  };
  require(s.side >= kBase && s.side <= 1024 && std::has_single_bit(static_cast<unsigned>(s.side)),
          fmt::format("side must be a power of two in [{}, 1024], not {}", kBase, s.side));
  require(s.patterns >= 1, fmt::format("patterns must be positive, not {}", s.patterns));
  require(s.epochs >= 1, fmt::format("epochs must be positive, not {}", s.epochs));
  require(s.least_sites >= 2 && s.least_sites <= s.most_sites,
          fmt::format("sites must be at least two, the least ({}) not above the most ({})",
                      s.least_sites, s.most_sites));
  require(std::isfinite(s.learning_rate) && s.learning_rate > 0,
          fmt::format("learning rate must be positive, not {}", s.learning_rate));
}

/// Of all representations; what is damaged in the check points is told of before anything is
/// learned.
std::deque<ImageTraining> make_trainings(const StudySettings& settings, const StudyRun& run) {
  std::deque<ImageTraining> list;
  for (const Representation representation : neural::kRepresentations) {
    list.emplace_back(representation, settings, run);
  }
  return list;
}

}  // namespace

neural::RepresentationStudy study_representations(const StudySettings& settings,
                                                  const StudyRun& run) {
  check(settings);
  torch::set_num_threads(std::max(1, run.threads));
  use_right_convolutions();
  std::deque<ImageTraining> trainings = make_trainings(settings, run);
  Random random(settings.seed);
  std::vector<Labels> truth;
  neural::RepresentationStudy result{.settings = settings, .true_regions = {}, .outcomes = {}};
  for (int n = 0; n < settings.patterns; ++n) {
    stop_if_asked(run);
    truth.push_back(voronoi(settings, random));
    result.true_regions.push_back(count_of(truth.back()));
  }
  for (ImageTraining& training : trainings) {
    result.outcomes.push_back(study(truth, training, settings, run));
  }
  return result;
}

std::vector<int> study_epochs_left(const StudySettings& settings, const StudyRun& run) {
  check(settings);
  std::vector<int> left;
  for (const ImageTraining& training : make_trainings(settings, run)) {
    left.push_back(training.epochs_left());
  }
  return left;
}

}  // namespace fracbench::training
