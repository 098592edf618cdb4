#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/arguments.h"
#include "app/command.h"
#include "app/command_progress.h"
#include "core/context.h"
#include "core/error.h"
#include "harness/learning_set.h"
#include "methods/deepfracture/patterns.h"
#include "methods/deepfracture/round_trip.h"
#include "methods/deepfracture/settings.h"
#include "metrics/summary.h"
#include "neural/data_set.h"

namespace fracbench {

namespace {

struct ExportArguments {
  std::filesystem::path folder;
  std::string shape;
  std::filesystem::path out;
  std::vector<int> resolutions = {128};
  int features = 1;
  double truncation = 0;
  bool test = false;
  bool ceiling = false;
  int threads = 2;
  bool as_json = false;
};

/// How well the patterns come back from exact fields: adjusted Rand indices.
struct Ceiling {
  int resolution = 0;
  std::vector<double> index;
};

/// The learning data of a folder: itself, or what lies in it beside results.
std::filesystem::path learning_folder(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "learning.json") ? folder : folder / "learning";
}

const LearningShape& chosen_shape(const LearningIndex& index, const ExportArguments& a) {
  if (!a.shape.empty()) return index.shape(a.shape, a.folder.string());
  if (index.shapes.size() != 1) {
    throw InputError(fmt::format("{}: holds {} shapes; choose one with --shape", a.folder.string(),
                                 index.shapes.size()));
  }
  return index.shapes.front();
}

ExitCode export_learning(const ExportArguments& a, std::stop_token stop) {
  const std::filesystem::path folder = learning_folder(a.folder);
  const LearningIndex index = read_learning_index(folder);
  LearningShapeSet set = load_learning_shape(folder, chosen_shape(index, a));

  deepfracture::Settings settings;
  settings.network.resolutions = a.resolutions;
  settings.network.features = a.features;
  settings.truncation = a.truncation;
  settings.least_patterns = 1;
  neural::check(settings.network);

  const Target target{.name = set.label, .mesh = std::move(set.mesh), .material = {}};
  const LearningData learning{.examples = std::move(a.test ? set.test : set.train),
                              .max_impulse = set.max_impulse};
  Random random(0);
  StageTimer timer;
  CommandProgress progress;
  const Context context{
      .random = random, .timer = timer, .progress = progress, .stop = stop, .threads = a.threads};
  neural::DataSet data = make_data_set(target, learning, settings, context);
  data.provenance = nlohmann::ordered_json{
      {"suite", index.suite},
      {"method", index.method},
      {"method_options", index.method_options},
      {"family", index.family},
      {"role", a.test ? "test" : "train"},
      {"digest", set.digest},
      {"truncation",
       a.truncation}}.dump();
  neural::write_data_set(a.out, data);
  std::vector<Ceiling> ceilings;
  for (const int r : a.resolutions) {
    if (a.ceiling)
      ceilings.push_back({r, deepfracture::round_trip(learning, data, r, {}, context)});
  }
  if (a.as_json) {
    nlohmann::ordered_json json{{"shape", set.label},
                                {"patterns", data.patterns.size()},
                                {"resolutions", a.resolutions},
                                {"file", a.out.string()}};
    for (const Ceiling& c : ceilings) json["ceiling"][std::to_string(c.resolution)] = c.index;
    print_json(json);
  } else {
    for (const Ceiling& c : ceilings) {
      const Summary s = summarize(c.index);
      fmt::print("{}, r = {}: ceiling {:.3f} on average, {:.3f} at least, {:.3f} at most\n",
                 set.label, c.resolution, s.mean, s.minimum, s.maximum);
    }
    fmt::print("{} fractures of {} in {}; train with fracbench-train train {} --out MODEL\n",
               data.patterns.size(), set.label, a.out.string(), a.out.string());
  }
  return ExitCode::good;
}

}  // namespace

void add_export_learning_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
      "export-learning",
      "Write learning data as one data set file, to train deepfracture on another machine");
  auto a = std::make_shared<ExportArguments>();
  command
      ->add_option("folder", a->folder,
                   "Folder that 'fracbench prepare' made, or the results folder around it")
      ->required();
  command->add_option("--out", a->out, "The file to write")->required();
  command->add_option("--shape", a->shape, "Label of the shape, where there are several");
  command->add_option("--resolutions", a->resolutions, "r of the fields: of 32, 64, 128, 256")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--features", a->features, "Impulses of each collision, 1 or 2")
      ->capture_default_str();
  command->add_option("--truncation", a->truncation, "Limit of the fields, m; 0: none")
      ->capture_default_str();
  command->add_flag("--test", a->test, "The collisions that are kept for tests");
  command->add_flag("--ceiling", a->ceiling,
                    "Also say how well exact fields come back through segmentation (adjusted Rand "
                    "index): what no prediction can exceed");
  command->add_option("--threads", a->threads)->capture_default_str();
  command->add_flag("--json", a->as_json, "Print what was written as JSON");
  command->callback(
      [&chosen, a] { chosen = [a](std::stop_token stop) { return export_learning(*a, stop); }; });
}

}  // namespace fracbench
