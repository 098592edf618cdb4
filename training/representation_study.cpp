#include "training/representation_study.h"

#include <fmt/format.h>
#include <torch/torch.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "core/adjusted_rand_index.h"
#include "core/error.h"
#include "core/random.h"
#include "training/adam.h"
#include "training/network.h"

namespace fracbench::training {

namespace {

using neural::Representation;
using neural::StudyOutcome;
using neural::StudySettings;
using Labels = std::vector<std::int32_t>;

constexpr int kCode = 32, kBase = 8, kChannels = 64;
constexpr double kSlope = 0.2, kEpsilon = 1e-5;
// Distances are learned in units of this many pixels, and truncated there.
constexpr double kUnit = 16;
// From where on a pixel belongs to a line.
constexpr float kLine = 0.5f;
// How much higher than the pass between them both of two summits of a distance have to be, to be
// two regions.
constexpr float kDepth = static_cast<float>(1.0 / kUnit);

/// Regions 0 to n - 1, in random order.
Labels voronoi(const StudySettings& o, Random& random) {
  const int count =
      o.least_sites +
      static_cast<int>(random.below(static_cast<std::uint64_t>(o.most_sites - o.least_sites + 1)));
  std::vector<std::pair<double, double>> sites;
  for (int n = 0; n < count; ++n) {
    const double x = random.uniform(0, o.side), y = random.uniform(0, o.side);
    sites.emplace_back(x, y);
  }
  Labels labels;
  for (int y = 0; y < o.side; ++y) {
    for (int x = 0; x < o.side; ++x) {
      const auto square = [&](const auto& site) {
        return std::pow(site.first - x, 2) + std::pow(site.second - y, 2);
      };
      labels.push_back(
          static_cast<std::int32_t>(std::ranges::min_element(sites, {}, square) - sites.begin()));
    }
  }
  return labels;
}

template <typename Visit>
void for_neighbours(int pixel, int side, const Visit& visit) {
  const int x = pixel % side, y = pixel / side;
  if (x > 0) visit(pixel - 1);
  if (x + 1 < side) visit(pixel + 1);
  if (y > 0) visit(pixel - side);
  if (y + 1 < side) visit(pixel + side);
}

std::vector<float> image_of(const Labels& labels, Representation representation, int side) {
  const auto count = static_cast<float>(1 + *std::ranges::max_element(labels));
  std::vector<float> image(labels.size());
  std::vector<int> border;
  for (int p = 0; p < static_cast<int>(labels.size()); ++p) {
    bool at_border = false;
    for_neighbours(p, side, [&](int q) { at_border |= labels[q] != labels[p]; });
    if (at_border) border.push_back(p);
    image[p] = representation == Representation::labels ? (labels[p] + 1.0f) / count
                                                        : (at_border ? 1.0f : 0.0f);
  }
  if (representation != Representation::distance) return image;
  for (int p = 0; p < static_cast<int>(labels.size()); ++p) {
    double least = 4.0 * side * side;
    for (const int q : border) {
      least = std::min(least, std::pow(p % side - q % side, 2) + std::pow(p / side - q / side, 2));
    }
    image[p] = static_cast<float>(std::min(1.0, std::sqrt(least) / kUnit));
  }
  return image;
}

/// Gives pixels without a region (-1) that of the nearest one that has.
Labels filled(Labels labels, int side) {
  std::deque<int> queue;
  for (int p = 0; p < static_cast<int>(labels.size()); ++p) {
    if (labels[p] >= 0) queue.push_back(p);
  }
  while (!queue.empty()) {
    const int p = queue.front();
    queue.pop_front();
    for_neighbours(p, side, [&](int q) {
      if (labels[q] >= 0) return;
      labels[q] = labels[p];
      queue.push_back(q);
    });
  }
  return labels;
}

/// The basins of a distance, as caged-SDF segmentation finds them in 3D: pixels from the highest
/// down join the region that they touch; where two regions meet, they become one if either rises
/// less than kDepth above the meeting place.
Labels basins_of(const std::vector<float>& image, int side) {
  std::vector<int> order(image.size()), parent(image.size(), -1);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](int p) { return image[p]; });
  const auto root = [&](int p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  };
  std::vector<int> summit(image.size());
  for (const int p : order) {
    if (image[p] < kDepth / 2) break;  // borders: flat, to be filled from both sides
    parent[p] = p;
    summit[p] = p;
    for_neighbours(p, side, [&](int q) {
      if (parent[q] < 0) return;
      const int a = root(p), b = root(q);
      if (a == b) return;
      const int lower = image[summit[a]] < image[summit[b]] ? a : b, higher = lower == a ? b : a;
      // The pixel itself, while it has no region yet, always joins.
      if (summit[lower] != p && image[summit[lower]] - image[p] >= kDepth) return;
      parent[lower] = higher;
    });
  }
  Labels labels;
  for (int p = 0; p < static_cast<int>(image.size()); ++p) {
    labels.push_back(parent[p] < 0 ? -1 : root(p));
  }
  return filled(std::move(labels), side);
}

/// Regions that an image stands for: by value, what is connected away from lines (whose pixels join
/// the nearest region), or the basins of a distance.
Labels regions_of(const std::vector<float>& image, Representation representation, int side,
                  int count) {
  Labels labels(image.size(), -1);
  if (representation == Representation::labels) {
    for (std::size_t p = 0; p < image.size(); ++p) {
      labels[p] = static_cast<std::int32_t>(std::lround(image[p] * static_cast<float>(count)));
    }
    return labels;
  }
  if (representation == Representation::distance) return basins_of(image, side);
  const auto inside = [&](int p) { return image[p] < kLine; };
  std::deque<int> queue;
  std::int32_t next = 0;
  for (int seed = 0; seed < static_cast<int>(image.size()); ++seed) {
    if (labels[seed] >= 0 || !inside(seed)) continue;
    labels[seed] = next;
    queue.push_back(seed);
    while (!queue.empty()) {
      const int p = queue.front();
      queue.pop_front();
      for_neighbours(p, side, [&](int q) {
        if (labels[q] >= 0 || !inside(q)) return;
        labels[q] = next;
        queue.push_back(q);
      });
    }
    ++next;
  }
  return filled(std::move(labels), side);
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

/// The regions called 0, 1, 2, ... in the order in which they appear.
Labels in_order(const Labels& labels) {
  std::map<std::int32_t, std::int32_t> names;
  Labels renamed;
  for (const std::int32_t label : labels) {
    renamed.push_back(
        names.try_emplace(label, static_cast<std::int32_t>(names.size())).first->second);
  }
  return renamed;
}

double count_of(const Labels& labels) {
  return static_cast<double>(std::set(labels.begin(), labels.end()).size());
}

/// Learns the targets by heart; returns the mean loss of each epoch.
std::vector<double> learn(ImageNetwork& network, const std::vector<torch::Tensor>& targets,
                          Representation representation, const StudySettings& s,
                          const StudyRun& run) {
  Adam adam(network.weights());
  std::vector<double> losses;
  for (int epoch = 0; epoch < s.epochs; ++epoch) {
    double sum = 0;
    for (std::size_t k = 0; k < targets.size(); ++k) {
      if (run.stop.stop_requested()) throw Cancelled();
      const torch::Tensor loss =
          loss_of(network.decode(static_cast<std::int64_t>(k)), targets[k], representation);
      sum += loss.item<double>();
      loss.backward();
      adam.step(epoch < 2 * s.epochs / 3 ? s.learning_rate : s.learning_rate / 6);
    }
    losses.push_back(sum / static_cast<double>(targets.size()));
    if (run.progress) {
      run.progress(static_cast<int>(representation) * s.epochs + epoch + 1, losses.back());
    }
  }
  return losses;
}

StudyOutcome study(const std::vector<Labels>& truth, Representation representation,
                   const StudySettings& s, const StudyRun& run) {
  Random random = Random(s.seed).fork(to_string(representation));
  ImageNetwork network(s, random);
  StudyOutcome outcome{.representation = representation};
  std::vector<torch::Tensor> targets;
  for (const Labels& labels : truth) {
    const std::vector<float> image = image_of(labels, representation, s.side);
    targets.push_back(tensor_of(image, {static_cast<std::int64_t>(image.size())}));
    std::ranges::copy(image, std::back_inserter(outcome.targets));
  }
  outcome.loss = learn(network, targets, representation, s, run);
  const torch::NoGradGuard none;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const int count = 1 + *std::ranges::max_element(truth[k]);
    const std::vector<float> image = values_of(network.decode(static_cast<std::int64_t>(k)));
    const Labels back = regions_of(image, representation, s.side, count);
    const Labels exact =
        regions_of(image_of(truth[k], representation, s.side), representation, s.side, count);
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

}  // namespace

neural::RepresentationStudy study_representations(const StudySettings& settings,
                                                  const StudyRun& run) {
  check(settings);
  torch::set_num_threads(std::max(1, run.threads));
  Random random(settings.seed);
  std::vector<Labels> truth;
  neural::RepresentationStudy result{.settings = settings, .true_regions = {}, .outcomes = {}};
  for (int n = 0; n < settings.patterns; ++n) {
    truth.push_back(voronoi(settings, random));
    result.true_regions.push_back(count_of(truth.back()));
  }
  for (const Representation representation : neural::kRepresentations) {
    result.outcomes.push_back(study(truth, representation, settings, run));
  }
  return result;
}

}  // namespace fracbench::training
