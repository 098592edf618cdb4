#include "neural/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/array_file.h"
#include "core/error.h"
#include "neural/made_of_file.h"

namespace fracbench::neural {

namespace {

constexpr ArrayFileKind kKind{.format = "fracbench model", .version = 2};
constexpr std::string_view kWeights = "weights/";
constexpr std::string_view kStatistics = "statistics/";

/// Takes arrays out of a file, of the sizes that are asked for.
class Taker {
 public:
  explicit Taker(ArrayFile& file) : file_(file) {}

  std::string text(const std::string& name) const {
    const auto found = file_.texts.find(name);
    if (found == file_.texts.end()) throw InputError(fmt::format("it has no text '{}'", name));
    return found->second;
  }
  std::vector<double> reals(const std::string& name, std::size_t size) {
    return checked(file_.reals, name, size);
  }
  std::vector<float> floats(const std::string& name, std::size_t size) {
    return checked(file_.floats, name, size);
  }
  std::vector<float> floats(const std::string& name) {
    return checked(file_.floats, name, file_.floats[name].size());
  }

 private:
  template <typename T>
  static std::vector<T> checked(std::map<std::string, std::vector<T>>& arrays,
                                const std::string& name, std::size_t size) {
    std::vector<T>& values = arrays[name];
    if (values.size() != size) {
      throw InputError(
          fmt::format("array '{}' has {} values, must have {}", name, values.size(), size));
    }
    if (!std::ranges::all_of(values, [](T v) { return std::isfinite(v); })) {
      throw InputError(fmt::format("array '{}' holds a value that is not finite", name));
    }
    return std::move(values);
  }

  ArrayFile& file_;
};

Model model_of(ArrayFile& file) {
  Taker take(file);
  Model model;
  model.network = network_options_from_json(nlohmann::ordered_json::parse(take.text("network")));
  model.shapes = take_shapes(file);
  model.provenance = take.text("provenance");
  const NetworkOptions& network = model.network;
  model.field_unit = take.reals("field_unit", 1)[0];
  if (!(model.field_unit > 0)) throw InputError("array 'field_unit' must hold a positive number");
  const auto code = static_cast<std::size_t>(network.impulse_code);
  model.siren = {.omega = network.omega,
                 .weight = take.floats("siren.weight", code * kImpulseValues),
                 .bias = take.floats("siren.bias", code)};
  for (const WeightSpec& spec : weight_specs(network)) {
    model.weights[spec.name] = take.floats(std::string(kWeights) + spec.name, spec.size());
  }
  if (network.decoder == Decoder::voxel && network.normalisation == Normalisation::batch &&
      network.statistics != Statistics::sample) {
    for (const DecoderLayer& layer : decoder_blocks(network)) {
      for (const char* what : {".mean", ".variance"}) {
        model.statistics[layer.name + what] = take.floats(
            std::string(kStatistics) + layer.name + what, static_cast<std::size_t>(layer.out));
      }
    }
  }
  model.codebook_pattern = file.integers["codebook_pattern"];
  model.codebook_shape = file.integers["codebook_shape"];
  if (model.codebook_shape.size() != model.codebook_pattern.size() ||
      !std::ranges::all_of(model.codebook_shape, [&](std::int32_t s) {
        return s >= 0 && static_cast<std::size_t>(s) < model.shapes.size();
      })) {
    throw InputError("array 'codebook_shape' does not fit its shapes");
  }
  model.codebook = take.floats(
      "codebook", model.codebook_pattern.size() * static_cast<std::size_t>(network.code_size()));
  const std::vector<double>& loss = file.reals["epoch_loss"];
  const std::vector<double>& seconds = file.reals["epoch_seconds"];
  if (loss.size() != seconds.size()) throw InputError("its epochs do not fit");
  for (std::size_t k = 0; k < loss.size(); ++k) model.epochs.push_back({loss[k], seconds[k]});
  return model;
}

}  // namespace

std::span<const float> Model::row(std::size_t k) const {
  const auto size = static_cast<std::size_t>(network.code_size());
  return std::span(codebook).subspan(k * size, size);
}

void write_model(const std::filesystem::path& path, const Model& model) {
  ArrayFile file;
  put_shapes(file, model.shapes);
  file.texts["network"] = to_json(model.network).dump();
  file.texts["provenance"] = model.provenance;
  file.reals["field_unit"] = {model.field_unit};
  for (const EpochRecord& epoch : model.epochs) {
    file.reals["epoch_loss"].push_back(epoch.loss);
    file.reals["epoch_seconds"].push_back(epoch.seconds);
  }
  ArrayViews views = file;
  views.floats["siren.weight"] = model.siren.weight;
  views.floats["siren.bias"] = model.siren.bias;
  views.floats["codebook"] = model.codebook;
  views.integers["codebook_pattern"] = model.codebook_pattern;
  views.integers["codebook_shape"] = model.codebook_shape;
  for (const auto& [name, values] : model.weights) {
    views.floats[std::string(kWeights) + name] = values;
  }
  for (const auto& [name, values] : model.statistics) {
    views.floats[std::string(kStatistics) + name] = values;
  }
  write_array_file(path, views, kKind);
}

Model read_model(const std::filesystem::path& path) { return made_of_file(path, kKind, model_of); }

std::vector<float> random_segment_code(int size, Random& random) {
  const double deviation = std::sqrt(2.0 / (size + 1));
  std::vector<float> code(static_cast<std::size_t>(size));
  for (float& value : code) value = static_cast<float>(deviation * random.normal());
  return code;
}

std::size_t nearest_row(const Model& model, std::size_t shape, std::span<const float> impulses,
                        Random& random) {
  const NetworkOptions& network = model.network;
  if (impulses.size() != static_cast<std::size_t>(network.features * kImpulseValues)) {
    throw InputError(fmt::format("the model takes {} impulses, {} values were given",
                                 network.features, impulses.size()));
  }
  std::vector<float> code = encode(model.siren, impulses);
  const std::vector<float> segment = random_segment_code(network.segment_code, random);
  code.insert(code.end(), segment.begin(), segment.end());
  std::optional<std::size_t> best;
  double least = INFINITY;
  for (std::size_t k = 0; k < model.rows(); ++k) {
    if (static_cast<std::size_t>(model.codebook_shape[k]) != shape) continue;
    const std::span<const float> row = model.row(k);
    double sum = 0;
    for (std::size_t c = 0; c < code.size(); ++c) {
      const double difference = static_cast<double>(code[c]) - row[c];
      sum += difference * difference;
    }
    if (sum < least) {
      least = sum;
      best = k;
    }
  }
  if (!best) {
    throw InputError(
        "the model's codebook has no row of this shape: it was not trained to the end of an epoch");
  }
  return *best;
}

}  // namespace fracbench::neural
