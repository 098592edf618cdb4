#include "training/training.h"

#include <fmt/format.h>
#include <torch/torch.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "core/digest.h"
#include "core/error.h"
#include "core/freed_memory.h"
#include "core/peak_memory.h"
#include "neural/field_decoder.h"
#include "neural/pix2pix_decoder.h"
#include "training/adam.h"
#include "training/checkpoint.h"
#include "training/convolution_check.h"
#include "training/network.h"

namespace fracbench::training {

namespace {

using Clock = std::chrono::steady_clock;
using neural::DataSet;
using neural::EpochRecord;
using neural::Model;
using neural::Pattern;

constexpr std::string_view kCodes = "segment_codes";
// Epochs whose time tells how long the rest will take.
constexpr std::size_t kTimedEpochs = 10;

torch::Device device_of(const std::string& name) {
  std::optional<torch::Device> device;
  try {
    device.emplace(name);
  } catch (const c10::Error&) {
    throw InputError(fmt::format(
        "unknown device '{}', must be cpu or cuda (cuda:1 and so on of several)", name));
  }
  if (device->is_cuda() && !torch::cuda::is_available()) {
    throw InputError(
        "there is no CUDA device, or this libtorch was built without CUDA; use --device cpu");
  }
  try {
    torch::zeros({1}, *device).item<float>();
  } catch (const c10::Error&) {
    throw InputError(fmt::format(
        "this libtorch cannot compute on the device '{}'; use --device cpu, or cuda where it is",
        name));
  }
  return *device;
}

void check_data(const DataSet& data, const neural::NetworkOptions& network) {
  if (data.patterns.empty()) {
    throw InputError("the data set holds no patterns: no collision broke the target");
  }
  if (network.decoder == neural::Decoder::pix2pix && data.shapes.size() > 1) {
    throw InputError(
        fmt::format("a pix2pix decoder goes by the impulse alone and can learn one shape; the data "
                    "set has {}",
                    names_of(data.shapes)));
  }
  if (data.features != network.features) {
    throw InputError(fmt::format("the data set has {} impulses a pattern, the network takes {}",
                                 data.features, network.features));
  }
  for (const int r : network.resolutions) {
    if (!data.patterns.front().fields.contains(r)) {
      throw InputError(
          fmt::format("the data set has no fields of resolution {}, which the network has", r));
    }
  }
}

/// Order of the patterns in an epoch: Fisher and Yates.
std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed, std::size_t epoch) {
  Random random(derive_seed(seed, {"epoch", std::to_string(epoch)}));
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
  return order;
}

/// Everything that changes while a network is trained.
class Training {
 public:
  Training(const DataSet& data, const TrainingOptions& options, const TrainingRun& run)
      : data_(data),
        options_(options),
        run_(run),
        device_(device_of(run.device)),
        random_(options.seed),
        siren_(make_encoder(options)),
        network_(initial_network(options, device_)),
        codes_(make_codes()),
        adam_(trained()) {
    id_ = digest();
    for (const Pattern& pattern : data.patterns) {
      const std::vector<float> code = neural::encode(siren_, pattern.impulses);
      impulse_codes_.push_back(
          tensor_of(code, {static_cast<std::int64_t>(code.size())}).to(device_));
      Sample& sample = samples_.emplace_back();
      for (const int r : options.network.resolutions) {
        sample.fields[r] =
            tensor_of(pattern.fields.at(r), {r, r, r}).div_(data.field_unit).to(device_);
      }
      if (options.network.decoder == neural::Decoder::pix2pix) {
        const int r = options.network.resolutions.back();
        sample.volume =
            tensor_of(neural::impulse_volume(pattern.impulses, data.shapes.front().scaling, r),
                      {r, r, r})
                .to(device_);
      }
    }
  }

  Model run() {
    restore();
    while (!finished()) {
      const auto start = Clock::now();
      EpochRecord epoch{.loss = one_epoch(), .seconds = 0};
      epoch.seconds = std::chrono::duration<double>(Clock::now() - start).count();
      epochs_.push_back(epoch);
      if (!run_.checkpoints.empty()) {
        write_checkpoint(run_.checkpoints, {id_, adam_.steps, epochs_}, tensors());
      }
      if (run_.progress) {
        run_.progress(static_cast<int>(epochs_.size()), epoch.loss, seconds_left());
      }
    }
    return model();
  }

 private:
  static neural::Siren make_encoder(const TrainingOptions& options) {
    Random random = Random(options.seed).fork("encoder");
    return neural::make_siren(options.network, random);
  }
  static std::unique_ptr<Network> initial_network(const TrainingOptions& options,
                                                  torch::Device device) {
    Random random = Random(options.seed).fork("weights");
    return make_network(options.network, random, device);
  }
  torch::Tensor make_codes() {
    Random random = random_.fork("segment codes");
    std::vector<float> values;
    const int size = options_.network.segment_code;
    for (std::size_t k = 0; k < data_.patterns.size(); ++k) {
      const std::vector<float> code = neural::random_segment_code(size, random);
      values.insert(values.end(), code.begin(), code.end());
    }
    return tensor_of(values, {static_cast<std::int64_t>(data_.patterns.size()), size})
        .to(device_)
        .requires_grad_(options_.segment_codes == SegmentCodes::trained);
  }
  std::map<std::string, torch::Tensor> trained() {
    std::map<std::string, torch::Tensor> list = network_->weights();
    if (options_.segment_codes == SegmentCodes::trained) list[std::string(kCodes)] = codes_;
    return list;
  }

  std::string digest() const {
    Digest digest;
    digest.add(neural::digest_of(data_));
    auto json = to_json(options_);
    json.erase("epochs");  // a training may be prolonged
    digest.add(json.dump());
    return digest.hex();
  }

  bool finished() const {
    if (epochs_.size() >= static_cast<std::size_t>(options_.epochs)) return true;
    return options_.stable_loss > 0 && !epochs_.empty() &&
           epochs_.back().loss < options_.stable_loss;
  }

  double seconds_left() const {
    const std::size_t count = std::min(kTimedEpochs, epochs_.size());
    double seconds = 0;
    for (std::size_t k = epochs_.size() - count; k < epochs_.size(); ++k) {
      seconds += epochs_[k].seconds;
    }
    return seconds / static_cast<double>(count) *
           (static_cast<double>(options_.epochs) - static_cast<double>(epochs_.size()));
  }

  torch::Tensor code_of(std::size_t pattern, Random& random) const {
    torch::Tensor segment;
    if (options_.segment_codes == SegmentCodes::trained) {
      segment = codes_[static_cast<std::int64_t>(pattern)];
    } else {
      const auto values = neural::random_segment_code(options_.network.segment_code, random);
      segment = tensor_of(values, {options_.network.segment_code}).to(device_);
    }
    return torch::cat({impulse_codes_[pattern], segment});
  }

  /// The mean loss.
  double one_epoch() {
    const std::size_t epoch = epochs_.size();
    const double rate = epoch < static_cast<std::size_t>(options_.later_from)
                            ? options_.learning_rate
                            : options_.later_rate;
    Random random(derive_seed(options_.seed, {"codes of epoch", std::to_string(epoch)}));
    double sum = 0;
    for (const std::size_t k : shuffled(data_.patterns.size(), options_.seed, epoch)) {
      if (run_.stop.stop_requested()) throw Cancelled();
      samples_[k].code = code_of(k, random);
      torch::Tensor loss = network_->loss(samples_[k], options_.loss, rate, random);
      const double value = loss.item<double>();
      if (!std::isfinite(value)) {
        throw TrainingFailure(fmt::format(
            "the loss is {} in step {} (epoch {}, pattern '{}'); {}try a lower learning rate",
            value, adam_.steps + 1, epoch + 1, data_.patterns[k].name,
            run_.checkpoints.empty() || epochs_.empty()
                ? ""
                : fmt::format("the check point of epoch {} is kept; ", epochs_.size())));
      }
      sum += value;
      loss.backward();
      adam_.step(rate);
    }
    return sum / static_cast<double>(data_.patterns.size());
  }

  /// All tensors that change, by their name in a check point.
  std::map<std::string, torch::Tensor> tensors() {
    std::map<std::string, torch::Tensor> list;
    for (auto& [name, tensor] : network_->weights()) list["weights/" + name] = tensor;
    for (auto& [name, tensor] : network_->statistics()) list["statistics/" + name] = tensor;
    for (auto& [name, tensor] : adam_.first) list["first/" + name] = tensor;
    for (auto& [name, tensor] : adam_.second) list["second/" + name] = tensor;
    for (auto& [name, tensor] : network_->further()) list["further/" + name] = tensor;
    list[std::string(kCodes)] = codes_;
    return list;
  }

  void restore() {
    if (run_.checkpoints.empty()) return;
    try {
      const auto kept = read_checkpoint(run_.checkpoints);
      if (!kept) return;
      if (kept->state.training != id_) {
        throw InputError(fmt::format("'{}' is of a training with other data or options",
                                     checkpoint_file(run_.checkpoints).string()));
      }
      put_arrays(*kept, tensors());
      adam_.steps = kept->state.steps;
      epochs_ = kept->state.epochs;
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("{}; give another folder, or remove it to begin anew", error.what()));
    }
  }

  /// Replaces the statistics by their mean over all patterns.
  void reestimate() {
    const torch::NoGradGuard none;
    network_->begin_statistics();
    Random random = random_.fork("reestimate");
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      samples_[k].code = code_of(k, random);
      network_->add_statistics(samples_[k]);
    }
    network_->end_statistics(samples_.size());
  }

  /// Equation (7): pairs of impulse code and segment code, sampled without replacement; as many of
  /// each shape, whose rows alone are asked for its fractures.
  void fill_codebook(Model& model) {
    Random random(derive_seed(options_.seed, {"codebook", std::to_string(epochs_.size())}));
    Random codes = random.fork("codes");
    std::map<int, std::vector<std::size_t>> of_shape;
    for (std::size_t k = 0; k < data_.patterns.size(); ++k) {
      of_shape[data_.patterns[k].shape].push_back(k);
    }
    std::vector<std::size_t> chosen;
    for (auto& [shape, patterns] : of_shape) {
      const std::size_t all = patterns.size();
      const std::size_t wanted =
          options_.codebook_rows == 0 ? all : std::min<std::size_t>(options_.codebook_rows, all);
      for (std::size_t k = 0; k < wanted; ++k) {
        std::swap(patterns[k], patterns[k + random.below(all - k)]);
        chosen.push_back(patterns[k]);
      }
    }
    std::ranges::sort(chosen);
    for (const std::size_t k : chosen) {
      const std::vector<float> row = values_of(code_of(k, codes));
      model.codebook.insert(model.codebook.end(), row.begin(), row.end());
      model.codebook_pattern.push_back(static_cast<std::int32_t>(k));
      model.codebook_shape.push_back(data_.patterns[k].shape);
    }
  }

  Model model() {
    const torch::NoGradGuard none;
    if (options_.network.statistics == neural::Statistics::reestimated) reestimate();
    Model model{.network = options_.network,
                .shapes = data_.shapes,
                .field_unit = data_.field_unit,
                .siren = siren_,
                .weights = {},
                .statistics = {},
                .codebook = {},
                .codebook_pattern = {},
                .codebook_shape = {},
                .epochs = epochs_,
                .provenance = provenance().dump()};
    for (const auto& [name, tensor] : network_->weights()) model.weights[name] = values_of(tensor);
    if (options_.network.decoder == neural::Decoder::voxel &&
        options_.network.normalisation == neural::Normalisation::batch &&
        options_.network.statistics != neural::Statistics::sample) {
      for (const auto& [name, tensor] : network_->statistics()) {
        model.statistics[name] = values_of(tensor);
      }
    }
    fill_codebook(model);
    return model;
  }

  nlohmann::ordered_json provenance() const {
    double seconds = 0;
    for (const EpochRecord& epoch : epochs_) seconds += epoch.seconds;
    auto names = nlohmann::ordered_json::array();
    for (const Pattern& pattern : data_.patterns) names.push_back(pattern.name);
    return {{"options", to_json(options_)},
            {"data", data_.provenance},
            {"patterns", names},
            {"training", id_},
            {"epochs", epochs_.size()},
            {"seconds", seconds},
            {"peak_memory_mb", static_cast<double>(peak_memory()) / (1 << 20)},
            {"threads", run_.threads},
            {"device", run_.device},
            {"libtorch", TORCH_VERSION}};
  }

  const DataSet& data_;
  const TrainingOptions& options_;
  const TrainingRun& run_;
  torch::Device device_;
  Random random_;
  neural::Siren siren_;
  std::unique_ptr<Network> network_;
  torch::Tensor codes_;
  Adam adam_;
  std::string id_;
  std::vector<torch::Tensor> impulse_codes_;
  std::vector<Sample> samples_;
  std::vector<EpochRecord> epochs_;
};

}  // namespace

Model train(const DataSet& data, const TrainingOptions& options, const TrainingRun& run) {
  neural::check(options.network);
  check_data(data, options.network);
  device_of(run.device);    // before anything is written
  keep_all_freed_memory();  // every step takes the same large blocks; a third of its time else
  torch::set_num_threads(std::max(1, run.threads));
  use_right_convolutions();
  if (!run.checkpoints.empty()) std::filesystem::create_directories(run.checkpoints);
  try {
    return Training(data, options, run).run();
  } catch (const c10::Error& error) {
    throw TrainingFailure(fmt::format("libtorch: {}", error.what_without_backtrace()));
  }
}

std::vector<double> pattern_losses(const Model& model, const DataSet& data, int threads) {
  const auto decoder = neural::make_decoder(model);
  std::vector<double> losses(data.patterns.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; row < model.rows(); ++row) {
    const auto pattern = static_cast<std::size_t>(model.codebook_pattern[row]);
    if (pattern >= data.patterns.size()) continue;
    double sum = 0, count = 0;
    for (const int r : model.network.resolutions) {
      const auto field =
          decoder->decode({model.row(row), data.patterns[pattern].impulses}, r, threads).values;
      const std::vector<float>& wanted = data.patterns[pattern].fields.at(r);
      double squares = 0;
      for (std::size_t k = 0; k < field.size(); ++k) {
        squares += std::pow(static_cast<double>(field[k]) - wanted[k], 2);
      }
      sum += squares / static_cast<double>(field.size());
      ++count;
    }
    losses[pattern] = sum / count / (data.field_unit * data.field_unit);
  }
  return losses;
}

}  // namespace fracbench::training
