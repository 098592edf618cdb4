#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "training/training.h"

namespace fracbench::training {

namespace {

using Json = nlohmann::ordered_json;

template <typename Enum, std::size_t N>
Enum parse(const Json& json, const std::array<Enum, N>& values, std::string_view what) {
  for (const Enum value : values) {
    if (json == to_string(value)) return value;
  }
  throw InputError(fmt::format("training: unknown {} {}", what, json.dump()));
}

void check(const TrainingOptions& o) {
  const auto require = [](bool good, std::string_view what) {
    if (!good) throw InputError(fmt::format("training: {}", what));
  };
  require(o.epochs >= 1 && o.epochs <= 1'000'000,
          fmt::format("epochs is {}, must be in [1, 1000000]", o.epochs));
  require(o.learning_rate > 0 && o.learning_rate <= 1 && o.later_rate > 0 && o.later_rate <= 1,
          fmt::format("learning rates are {} and {}, must be in (0, 1]", o.learning_rate,
                      o.later_rate));
  require(o.later_from >= 0, fmt::format("later_from is {}, must not be negative", o.later_from));
  require(o.codebook_rows >= 0,
          fmt::format("codebook_rows is {}, must not be negative", o.codebook_rows));
  require(o.stable_loss >= 0,
          fmt::format("stable_loss is {}, must not be negative", o.stable_loss));
}

}  // namespace

std::string_view to_string(Loss value) {
  switch (value) {
    case Loss::l2:
      return "l2";
    case Loss::eikonal:
      return "eikonal";
    case Loss::dice:
      return "dice";
  }
  return "";
}

std::string_view to_string(SegmentCodes value) {
  return value == SegmentCodes::trained ? "trained" : "random";
}

Json to_json(const TrainingOptions& o) {
  return {{"network", to_json(o.network)},    {"epochs", o.epochs},
          {"learning_rate", o.learning_rate}, {"later_from", o.later_from},
          {"later_rate", o.later_rate},       {"codebook_rows", o.codebook_rows},
          {"loss", to_string(o.loss)},        {"segment_codes", to_string(o.segment_codes)},
          {"stable_loss", o.stable_loss},     {"seed", o.seed}};
}

TrainingOptions training_options_from_json(const Json& json) {
  TrainingOptions o;
  try {
    o.network = neural::network_options_from_json(json.at("network"));
    o.epochs = json.at("epochs");
    o.learning_rate = json.at("learning_rate");
    o.later_from = json.at("later_from");
    o.later_rate = json.at("later_rate");
    o.codebook_rows = json.at("codebook_rows");
    o.loss = parse(json.at("loss"), std::array{Loss::l2, Loss::eikonal, Loss::dice}, "loss");
    o.segment_codes =
        parse(json.at("segment_codes"), std::array{SegmentCodes::trained, SegmentCodes::random},
              "segment_codes");
    o.stable_loss = json.at("stable_loss");
    o.seed = json.at("seed");
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("training: {}", error.what()));
  }
  check(o);
  return o;
}

}  // namespace fracbench::training
