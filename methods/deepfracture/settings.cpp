#include "methods/deepfracture/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/error.h"

namespace fracbench::deepfracture {

namespace {

using neural::Normalisation;
using neural::Statistics;

// What the authors' program adds to variances in batch normalisation.
constexpr double kParityEpsilon = 0.8;

template <typename Enum>
Enum parse(const std::string& text, std::initializer_list<Enum> values) {
  for (const Enum value : values) {
    if (text == to_string(value)) return value;
  }
  throw std::logic_error("option value " + text);
}

OptionSpec number(std::string name, double fallback, std::string unit, std::string summary,
                  double minimum, double maximum) {
  return {.name = std::move(name),
          .fallback = fallback,
          .unit = std::move(unit),
          .summary = std::move(summary),
          .minimum = minimum,
          .maximum = maximum};
}

OptionSpec integer(std::string name, std::int64_t fallback, std::string unit, std::string summary,
                   double minimum, double maximum) {
  return {.name = std::move(name),
          .fallback = fallback,
          .unit = std::move(unit),
          .summary = std::move(summary),
          .minimum = minimum,
          .maximum = maximum};
}

OptionSpec choice(std::string name, std::string summary, std::vector<std::string> choices) {
  return {.name = std::move(name),
          .fallback = choices.front(),
          .unit = "",
          .summary = std::move(summary),
          .choices = choices};
}

std::vector<int> resolutions_from(const Options& options) {
  std::vector<int> list;
  for (const double r : options.numbers("resolutions")) {
    if (r != std::floor(r)) {
      throw InputError(fmt::format("deepfracture: resolution {} is not 32, 64, 128 or 256", r));
    }
    list.push_back(static_cast<int>(r));
  }
  return list;
}

}  // namespace

OptionsSchema options_schema() {
  return {
      {.name = "resolutions",
       .fallback = std::vector<double>{128},
       .unit = "voxels",
       .summary = "r of the network's outputs, ascending: some of 32, 64, 128, 256"},
      integer("resolution", 0, "voxels", "r of the output that is cut; 0: the finest", 0, 256),
      number("width", 1, "", "factor of all channel counts; 1 is the paper's 47 M parameters",
             1.0 / 64, 4),
      integer("features", 1, "", "impulses that the network is given, strongest first", 1, 2),
      integer("segment_code", 8, "", "values of a segment code", 0, 4096),
      number("omega", 1, "", "w_0 of the encoder", 1e-3, 1000),
      choice("normalisation", "over the voxels of a sample, by channel or by groups of channels",
             {"batch", "group"}),
      choice("statistics", "of batch normalisation where the network predicts",
             {"sample", "running", "reestimated"}),
      choice("decoder", "voxel: the paper's; implicit and pix2pix: its ablations",
             {"voxel", "implicit", "pix2pix"}),
      integer("epochs", 1000, "", "passes over all patterns", 1, 1e6),
      number("learning_rate", 0.003, "", "of Adam", 1e-9, 1),
      integer("later_from", 400, "", "epochs after which the later rate holds", 0, 1e6),
      number("later_rate", 0.0005, "", "of Adam", 1e-9, 1),
      choice("loss", "what training makes small", {"l2", "eikonal", "dice"}),
      choice("segment_codes", "random: the ablation without segment codes", {"trained", "random"}),
      number("stable_loss", 0, "", "training ends after an epoch with a lower loss; 0: never", 0,
             1),
      integer("codebook_rows", 0, "", "N_space, of each shape; 0: one for each training pattern", 0,
              1e6),
      {.name = "quantise",
       .fallback = true,
       .unit = "",
       .summary = "decode the codebook's nearest row; false: the ablation without it"},
      number("truncation", 0, "m",
             "limit of the fields to learn from, which the network learns in units of it; 0: none",
             0, 10),
      integer("least_patterns", 2, "", "fewer fractures to learn from are refused", 1, 1e6),
      number("cage", 0, "m", "width added around the body; 0: 0.03, or half a voxel", 0, 1),
      number("h", 3, "of 255", "depth that a basin needs to become a fragment", 0, 255),
      integer("most_fragments", 1000, "", "a field of more is a failure: it has not been learned",
              2, 1e6),
      choice("fracture_surfaces", "how fine they are: as the grid, or as the body's own surface",
             {"as-grid", "as-surface"}),
      {.name = "parity",
       .fallback = false,
       .unit = "",
       .summary = "as the authors' program: dams and small fragments are lost, variances + 0.8"},
      {.name = "model",
       .fallback = std::string(),
       .unit = "",
       .summary = "file of a model that fracbench-train made; empty: train one"},
  };
}

Settings settings_from(const Options& options) {
  Settings s;
  const bool parity = options.flag("parity");
  s.network.resolutions = resolutions_from(options);
  s.network.width = options.number("width");
  s.network.features = static_cast<int>(options.integer("features"));
  s.network.segment_code = static_cast<int>(options.integer("segment_code"));
  s.network.omega = options.number("omega");
  s.network.normalisation =
      parse(options.text("normalisation"), {Normalisation::batch, Normalisation::group});
  s.network.statistics = parse(options.text("statistics"),
                               {Statistics::sample, Statistics::running, Statistics::reestimated});
  s.network.decoder =
      parse(options.text("decoder"),
            {neural::Decoder::voxel, neural::Decoder::implicit, neural::Decoder::pix2pix});
  if (parity) s.network.epsilon = kParityEpsilon;
  neural::check(s.network);
  s.resolution = static_cast<int>(options.integer("resolution"));
  if (s.resolution == 0) s.resolution = s.network.resolutions.back();
  s.epochs = static_cast<int>(options.integer("epochs"));
  s.learning_rate = options.number("learning_rate");
  s.later_from = static_cast<int>(options.integer("later_from"));
  s.later_rate = options.number("later_rate");
  s.loss = options.text("loss");
  s.segment_codes = options.text("segment_codes");
  s.stable_loss = options.number("stable_loss");
  s.codebook_rows = static_cast<int>(options.integer("codebook_rows"));
  s.quantise = options.flag("quantise");
  s.truncation = options.number("truncation");
  s.least_patterns = static_cast<int>(options.integer("least_patterns"));
  s.model = options.text("model");
  if (options.number("cage") > 0) s.reconstruct.segmentation.cage = options.number("cage");
  s.reconstruct.segmentation.h = options.number("h");
  s.reconstruct.segmentation.parity = parity;
  s.reconstruct.most_fragments = static_cast<int>(options.integer("most_fragments"));
  s.reconstruct.as_coarse_as_surface = options.text("fracture_surfaces") == "as-surface";
  if (s.model.empty() &&
      std::ranges::find(s.network.resolutions, s.resolution) == s.network.resolutions.end()) {
    throw InputError(
        fmt::format("deepfracture: resolution is {}, which is not among the network's resolutions",
                    s.resolution));
  }
  return s;
}

nlohmann::ordered_json Settings::training() const {
  return {{"network", to_json(network)},
          {"epochs", epochs},
          {"learning_rate", learning_rate},
          {"later_from", later_from},
          {"later_rate", later_rate},
          {"codebook_rows", codebook_rows},
          {"loss", loss},
          {"segment_codes", segment_codes},
          {"stable_loss", stable_loss},
          {"seed", seed}};
}

}  // namespace fracbench::deepfracture
