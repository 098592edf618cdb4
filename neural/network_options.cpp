#include "neural/network_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace fracbench::neural {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kNormalisations = {Normalisation::batch, Normalisation::group};
constexpr std::array kDecoders = {Decoder::voxel, Decoder::implicit, Decoder::pix2pix};
constexpr std::array kStatistics = {Statistics::sample, Statistics::running,
                                    Statistics::reestimated};

template <typename Enum, std::size_t N>
Enum parse(const Json& json, const std::array<Enum, N>& values, std::string_view what) {
  for (const Enum value : values) {
    if (json == to_string(value)) return value;
  }
  throw InputError(fmt::format("unknown {} {}", what, json.dump()));
}

int channels(int paper, const NetworkOptions& options) {
  // A multiple of eight, for the groups of group normalisation and the vectors of the processor.
  return std::max(8, 8 * static_cast<int>(std::lround(paper * options.width / 8)));
}

void add_normalisation(const std::string& name, int size, std::vector<WeightSpec>& list) {
  list.push_back({name + ".scale", {size}});
  list.push_back({name + ".shift", {size}});
}

void add_convolution(const std::string& name, int from, int to, std::vector<WeightSpec>& list) {
  list.push_back({name + ".weight", {from, to, 4, 4, 4}});
}

std::vector<WeightSpec> implicit_specs(const NetworkOptions& options) {
  const int hidden = hidden_values(options), input = options.code_size() + 3;
  std::vector<WeightSpec> list;
  for (int k = 0; k <= kHiddenLayers; ++k) {
    const int from = k == 0 ? input : k == kSkipLayer ? hidden + input : hidden;
    const int to = k == kHiddenLayers ? 1 : hidden;
    list.push_back({fmt::format("layer{}.weight", k), {to, from}});
    list.push_back({fmt::format("layer{}.bias", k), {to}});
  }
  return list;
}

std::vector<WeightSpec> unet_specs(const NetworkOptions& options) {
  const std::vector<int> channels = unet_channels(options);
  const auto depth = static_cast<int>(channels.size());
  std::vector<WeightSpec> list;
  for (int k = 0; k < depth; ++k) {
    const std::string name = fmt::format("down{}", k);
    list.push_back({name + ".weight", {channels[k], k == 0 ? 1 : channels[k - 1], 4, 4, 4}});
    list.push_back({name + ".bias", {channels[k]}});
    if (k > 0) add_normalisation(name, channels[k], list);
  }
  for (int k = depth - 1; k >= 0; --k) {
    const std::string name = fmt::format("up{}", k);
    const int from = k == depth - 1 ? channels[k] : 2 * channels[k];
    const int to = k == 0 ? 1 : channels[k - 1];
    add_convolution(name, from, to, list);
    if (k == 0) continue;
    list.push_back({name + ".bias", {to}});
    add_normalisation(name, to, list);
  }
  return list;
}

}  // namespace

int hidden_values(const NetworkOptions& options) { return channels(512, options); }

std::vector<int> unet_channels(const NetworkOptions& options) {
  std::vector<int> list;
  int paper = 64;
  for (int side = options.resolutions.back() / 2; side >= 4; side /= 2) {
    list.push_back(channels(paper, options));
    paper = std::min(2 * paper, 512);
  }
  return list;
}

std::vector<WeightSpec> weight_specs(const NetworkOptions& options) {
  if (options.decoder == Decoder::implicit) return implicit_specs(options);
  if (options.decoder == Decoder::pix2pix) return unet_specs(options);
  const int base = base_channels(options) * kBaseSide * kBaseSide * kBaseSide;
  std::vector<WeightSpec> list = {{"linear.weight", {base, options.code_size()}},
                                  {"linear.bias", {base}}};
  for (const DecoderLayer& layer : decoder_blocks(options)) {
    add_convolution(layer.name, layer.in, layer.out, list);
    list.push_back({layer.name + ".bias", {layer.out}});
    add_normalisation(layer.name, layer.out, list);
  }
  for (const DecoderLayer& layer : decoder_heads(options)) {
    add_convolution(layer.name, layer.in, layer.out, list);
  }
  return list;
}

int base_channels(const NetworkOptions& options) { return channels(512, options); }

std::vector<DecoderLayer> decoder_blocks(const NetworkOptions& options) {
  std::vector<DecoderLayer> layers;
  int from = base_channels(options), paper = 256;
  for (int side = kBaseSide; 4 * side <= options.resolutions.back(); side *= 2, paper /= 2) {
    const int to = channels(paper, options);
    layers.push_back({fmt::format("block{}", layers.size()), from, to, side});
    from = to;
  }
  return layers;
}

std::vector<DecoderLayer> decoder_heads(const NetworkOptions& options) {
  std::vector<DecoderLayer> heads;
  for (const DecoderLayer& layer : decoder_blocks(options)) {
    const int resolution = 4 * layer.side;
    if (std::ranges::find(options.resolutions, resolution) == options.resolutions.end()) continue;
    heads.push_back({fmt::format("head{}", resolution), layer.out, 1, 2 * layer.side});
  }
  return heads;
}

std::size_t WeightSpec::size() const {
  std::size_t product = 1;
  for (const int n : shape) product *= static_cast<std::size_t>(n);
  return product;
}

std::size_t parameter_count(const NetworkOptions& options) {
  std::size_t count = 0;
  for (const WeightSpec& spec : weight_specs(options)) count += spec.size();
  return count;
}

void check(const NetworkOptions& options) {
  const auto require = [](bool good, std::string_view what) {
    if (!good) throw InputError(fmt::format("network: {}", what));
  };
  require(!options.resolutions.empty(), "resolutions is empty, must hold some of 32, 64, 128, 256");
  for (const int r : options.resolutions) {
    require(r == 32 || r == 64 || r == 128 || r == 256,
            fmt::format("resolution {} must be 32, 64, 128 or 256", r));
  }
  require(std::ranges::adjacent_find(options.resolutions, std::greater_equal{}) ==
              options.resolutions.end(),
          fmt::format("resolutions {} must ascend", options.resolutions));
  require(options.width >= 1.0 / 64 && options.width <= 4,
          fmt::format("width is {}, must be in [1/64, 4]", options.width));
  require(options.features == 1 || options.features == 2,
          fmt::format("features is {}, must be 1 or 2", options.features));
  require(options.impulse_code >= 1 && options.impulse_code <= 4096,
          fmt::format("impulse_code is {}, must be in [1, 4096]", options.impulse_code));
  require(options.segment_code >= 0 && options.segment_code <= 4096,
          fmt::format("segment_code is {}, must be in [0, 4096]", options.segment_code));
  require(options.omega > 0 && options.omega <= 1000,
          fmt::format("omega is {}, must be in (0, 1000]", options.omega));
  require(options.slope >= 0 && options.slope < 1,
          fmt::format("slope is {}, must be in [0, 1)", options.slope));
  require(options.decoder != Decoder::pix2pix || options.resolutions.size() == 1,
          "a pix2pix decoder has one resolution only");
  require(options.epsilon > 0 && options.epsilon <= 10,
          fmt::format("epsilon is {}, must be in (0, 10]", options.epsilon));
}

std::string_view to_string(Normalisation value) {
  return value == Normalisation::batch ? "batch" : "group";
}

std::string_view to_string(Decoder value) {
  switch (value) {
    case Decoder::voxel:
      return "voxel";
    case Decoder::implicit:
      return "implicit";
    case Decoder::pix2pix:
      return "pix2pix";
  }
  return "";
}

std::string_view to_string(Statistics value) {
  switch (value) {
    case Statistics::sample:
      return "sample";
    case Statistics::running:
      return "running";
    case Statistics::reestimated:
      return "reestimated";
  }
  return "";
}

Json to_json(const NetworkOptions& o) {
  return {{"resolutions", o.resolutions},
          {"width", o.width},
          {"features", o.features},
          {"impulse_code", o.impulse_code},
          {"segment_code", o.segment_code},
          {"omega", o.omega},
          {"slope", o.slope},
          {"normalisation", to_string(o.normalisation)},
          {"statistics", to_string(o.statistics)},
          {"decoder", to_string(o.decoder)},
          {"epsilon", o.epsilon}};
}

NetworkOptions network_options_from_json(const Json& json) {
  NetworkOptions o;
  try {
    o.resolutions = json.at("resolutions").get<std::vector<int>>();
    o.width = json.at("width");
    o.features = json.at("features");
    o.impulse_code = json.at("impulse_code");
    o.segment_code = json.at("segment_code");
    o.omega = json.at("omega");
    o.slope = json.at("slope");
    o.normalisation = parse(json.at("normalisation"), kNormalisations, "normalisation");
    o.statistics = parse(json.at("statistics"), kStatistics, "statistics");
    o.decoder = parse(json.at("decoder"), kDecoders, "decoder");
    o.epsilon = json.at("epsilon");
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("network: {}", error.what()));
  }
  check(o);
  return o;
}

}  // namespace fracbench::neural
