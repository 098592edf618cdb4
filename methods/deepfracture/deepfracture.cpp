#include "methods/deepfracture/deepfracture.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/material_json.h"
#include "core/temporary_folder.h"
#include "methods/deepfracture/deepfracture_body.h"
#include "methods/deepfracture/patterns.h"
#include "methods/deepfracture/settings.h"
#include "methods/deepfracture/trainer.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;
using deepfracture::DeepFractureBody;
using deepfracture::Settings;

// Patterns of a shape that the ceiling and the decoder are judged with: enough for a mean.
constexpr std::size_t kJudged = 100;

/// A folder to work in: the one that outlives interruptions where there is one, else one of our own
/// that is removed.
class WorkFolder {
 public:
  explicit WorkFolder(const fs::path& checkpoints) : path_(checkpoints) {
    if (!path_.empty()) {
      fs::create_directories(path_);
      return;
    }
    temporary_.emplace("training");
    path_ = temporary_->path();
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  std::optional<TemporaryWorkFolder> temporary_;
};

neural::Model trained(const neural::DataSet& data, const Settings& settings,
                      const Context& context) {
  const WorkFolder folder(context.checkpoints);
  const fs::path data_set = folder.path() / "patterns.data", model = folder.path() / "model";
  neural::write_data_set(data_set, data);
  deepfracture::run_trainer({.data_set = data_set,
                             .model = model,
                             .checkpoints = folder.path(),
                             .options = settings.training().dump(2)},
                            context);
  return neural::read_model(model);
}

}  // namespace

MethodInfo DeepFractureMethod::info() const {
  MethodInfo info;
  info.name = "deepfracture";
  info.summary = "fracture patterns predicted by a network that learned from crack propagation";
  info.publications = {
      {.key = "huang-deepfracture",
       .authors = "Yuhang Huang and Takashi Kanai",
       .title = "DeepFracture: A Generative Approach for Predicting Brittle Fractures with Neural "
                "Discrete Representation Learning",
       .journal = "",
       .note = "The University of Tokyo"}};
  info.shape_type = "crack-propagation like";
  info.random = true;
  info.learns = true;
  info.learns_several = true;
  info.volume_tolerance = 1;  // material is lost under parity; else reconstruct() checks
  return info;
}

OptionsSchema DeepFractureMethod::options() const { return deepfracture::options_schema(); }

std::unique_ptr<Breakable> DeepFractureMethod::prepare(const Target& target,
                                                       const LearningData& learning,
                                                       const Options& options,
                                                       Context& context) const {
  Settings settings = deepfracture::settings_from(options);
  if (!settings.model.empty()) {
    return std::make_unique<DeepFractureBody>(target, settings, neural::read_model(settings.model),
                                              std::vector<deepfracture::Agreement>{});
  }
  if (!learning.further.empty() && !settings.quantise) {
    throw InputError(
        "deepfracture: of several shapes only the rows of the codebook tell which one is meant: "
        "set "
        "option 'quantise' to true, or remove learn_with");
  }
  settings.seed = context.random.bits() >> 1;  // a number that every reader of JSON understands
  neural::DataSet data;
  {
    const auto stage = context.timer.stage("distance_fields");
    data = make_data_set(target, learning, settings, context);
    data.provenance = nlohmann::ordered_json{{"material", breaking_json(target.material)},
                                             {"truncation", settings.truncation}}
                          .dump();
  }
  neural::Model model;
  {
    const auto stage = context.timer.stage("training");
    model = trained(data, settings, context);
  }
  const auto stage = context.timer.stage("judging");
  std::vector<deepfracture::Agreement> agreement =
      measure_agreement(target, learning, data, model, settings, context, kJudged);
  return std::make_unique<DeepFractureBody>(target, settings, std::move(model),
                                            std::move(agreement));
}

bool DeepFractureMethod::learns(const Options& options) const {
  return options.text("model").empty();
}

std::optional<double> DeepFractureMethod::learning_seconds(const Options& options,
                                                           std::size_t examples,
                                                           const TrainingMachine& machine) const {
  if (!learns(options)) return std::nullopt;
  const Settings settings = deepfracture::settings_from(options);
  return deepfracture::training_seconds(settings.training().dump(), examples, machine);
}

std::vector<fs::path> DeepFractureMethod::files(const Options& options) const {
  if (learns(options)) return {};
  return {options.text("model")};
}

std::unique_ptr<Breakable> DeepFractureMethod::load(const fs::path& folder, const Target& target,
                                                    const Options& options) const {
  return load_body(folder, target, deepfracture::settings_from(options));
}

}  // namespace fracbench
