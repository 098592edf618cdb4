// fracbench-train: trains the network of the method deepfracture from a data set file alone, on any
// machine with libtorch. fracbench itself calls it, too.

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/process_tree.h"
#include "neural/blas_kernels.h"
#include "neural/data_set.h"
#include "neural/model.h"
#include "neural/representation_study.h"
#include "training/representation_study.h"
#include "training/training.h"
#include "training/training_time.h"

namespace {

using namespace fracbench;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

enum Exit { kGood = 0, kInternal = 1, kBadInput = 2, kNotDone = 4 };

constexpr const char* kProgram = "fracbench-train:";
constexpr const char* kAbout =
    "Trains the network of fracbench's method deepfracture from a data set file.\n"
    "An interrupted training or study goes on where it was when the same command is given again.\n";

struct Arguments {
  std::vector<std::string> data;
  std::string out, checkpoints, options_file, device = "cpu";
  std::vector<std::string> set;
  int threads = 1;
  int patterns = 200;
  bool lines = false;
};

std::string duration(double seconds) {
  return fmt::format("{:%H:%M:%S}", std::chrono::seconds(static_cast<long>(seconds + 0.5)));
}

/// Shows an epoch: machine-readable lines, one changing line on a terminal, else a line now and
/// then.
class Shown {
 public:
  Shown(bool lines, int epochs)
      : lines_(lines), terminal_(::isatty(STDERR_FILENO) == 1), epochs_(epochs) {}
  ~Shown() {
    if (terminal_ && any_) fmt::print(stderr, "\n");
  }
  Shown(const Shown&) = delete;
  Shown& operator=(const Shown&) = delete;

  void operator()(int epoch, double loss, double left) {
    if (lines_) {
      fmt::print("epoch {} {} {:.9g} {:.1f}\n", epoch, epochs_, loss, left);
      std::fflush(stdout);
      return;
    }
    if (Clock::now() - last_ < std::chrono::milliseconds(terminal_ ? 200 : 10000)) return;
    last_ = Clock::now();
    any_ = true;
    fmt::print(stderr, "{}epoch {} of {}, loss {:.6f}, {} left{}", terminal_ ? "\r" : "", epoch,
               epochs_, loss, duration(left), terminal_ ? "   " : "\n");
  }

 private:
  bool lines_, terminal_, any_ = false;
  int epochs_;
  Clock::time_point last_;
};

Json read_json(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError(fmt::format("'{}' cannot be read", file));
  try {
    return Json::parse(stream);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("'{}': {}", file, error.what()));
  }
}

/// Puts `network.width=0.25` into the options: the value as JSON, or else as text.
void set_option(Json& options, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw InputError(fmt::format("--set {}: must be NAME=VALUE", assignment));
  }
  Json* at = &options;
  std::string name = assignment.substr(0, equals);
  if (name.starts_with("network.")) {
    at = &options["network"];
    name = name.substr(8);
  }
  if (!at->contains(name) || name == "network") {
    std::vector<std::string> known;
    for (const auto& [key, value] : options.items()) {
      if (key != "network") known.push_back(key);
    }
    for (const auto& [key, value] : options["network"].items()) known.push_back("network." + key);
    throw InputError(fmt::format("--set {}: there is no such option; there are {}", assignment,
                                 fmt::join(known, ", ")));
  }
  const std::string value = assignment.substr(equals + 1);
  Json parsed = Json::parse(value, nullptr, /*allow_exceptions=*/false);
  (*at)[name] = parsed.is_discarded() ? Json(value) : std::move(parsed);
}

/// The defaults, changed by the file and the single options that were given.
training::TrainingOptions options_from(const training::TrainingOptions& defaults,
                                       const Arguments& a) {
  Json json = training::to_json(defaults);
  if (!a.options_file.empty()) json = read_json(a.options_file);
  for (const std::string& assignment : a.set) set_option(json, assignment);
  return training::training_options_from_json(json);
}

int train(const Arguments& a, std::stop_token stop) {
  std::vector<neural::DataSet> sets;
  for (const std::string& file : a.data) sets.push_back(neural::read_data_set(file));
  const neural::DataSet data = neural::joined(std::move(sets));
  training::TrainingOptions defaults;
  defaults.network.features = std::max(1, data.features);
  if (!data.patterns.empty()) {
    defaults.network.resolutions.clear();
    for (const auto& [r, field] : data.patterns.front().fields) {
      defaults.network.resolutions.push_back(r);
    }
  }
  const training::TrainingOptions options = options_from(defaults, a);

  if (!a.lines) {
    fmt::print(stderr, "{}: {} patterns, {:.1f} million parameters\n", names_of(data.shapes),
               data.patterns.size(),
               static_cast<double>(neural::parameter_count(options.network)) / 1e6);
  }
  Shown shown(a.lines, options.epochs);
  const training::TrainingRun run{
      .threads = a.threads,
      .device = a.device,
      .checkpoints = a.checkpoints.empty() ? a.out + ".checkpoints" : a.checkpoints,
      .stop = stop,
      .progress = std::ref(shown)};
  neural::write_model(a.out, training::train(data, options, run));
  if (!a.lines) fmt::print(stderr, "\n{}\n", a.out);
  return kGood;
}

int time_training(const Arguments& a, std::stop_token stop) {
  const training::TrainingOptions options = options_from({}, a);
  const double step =
      training::seconds_per_step(options, {.threads = a.threads, .device = a.device, .stop = stop});
  const double steps = static_cast<double>(options.epochs) * a.patterns;
  if (a.lines) {
    fmt::print("seconds {:.9g}\n", step * steps);
    return kGood;
  }
  fmt::print("a step takes {:.3g} s; {} epochs of {} patterns {} (hours:minutes:seconds)\n", step,
             options.epochs, a.patterns, duration(step * steps));
  return kGood;
}

Json describe(const std::vector<neural::LearnedShape>& shapes) {
  Json list = Json::array();
  for (const neural::LearnedShape& shape : shapes) {
    list.push_back({{"name", shape.name},
                    {"digest", shape.digest},
                    {"max_impulse", shape.scaling.max_impulse}});
  }
  return list;
}

Json describe(const neural::Model& model) {
  Json json{{"kind", "model"},
            {"shapes", describe(model.shapes)},
            {"network", to_json(model.network)},
            {"parameters", neural::parameter_count(model.network)},
            {"codebook_rows", model.rows()},
            {"epochs", model.epochs.size()}};
  if (!model.epochs.empty()) json["loss"] = model.epochs.back().loss;
  const Json provenance = Json::parse(model.provenance, nullptr, false);
  json["provenance"] = provenance.is_discarded() ? Json(model.provenance) : provenance;
  return json;
}

Json describe(const neural::DataSet& data) {
  Json json{{"kind", "data set"},
            {"shapes", describe(data.shapes)},
            {"patterns", data.patterns.size()},
            {"features", data.features}};
  for (const auto& [r, field] :
       data.patterns.empty() ? std::map<int, std::vector<float>>() : data.patterns.front().fields) {
    json["resolutions"].push_back(r);
  }
  return json;
}

int info(const std::string& file, bool losses) {
  Json json;
  try {
    const neural::Model model = neural::read_model(file);
    json = describe(model);
    if (losses) {
      for (const neural::EpochRecord& epoch : model.epochs) {
        json["epoch_loss"].push_back(epoch.loss);
        json["epoch_seconds"].push_back(epoch.seconds);
      }
    }
  } catch (const InputError& not_a_model) {
    try {
      json = describe(neural::read_data_set(file));
    } catch (const InputError& not_a_data_set) {
      throw InputError(fmt::format("as a model: {}; as a data set: {}", not_a_model.what(),
                                   not_a_data_set.what()));
    }
  }
  fmt::print("{}\n", json.dump(2));
  return kGood;
}

struct StudyArguments {
  std::string out;
  neural::StudySettings settings;
  int threads = 1;
  bool lines = false;
  bool only_time = false;
};

void print_study(const neural::RepresentationStudy& result) {
  const auto mean = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  };
  fmt::print("representation,loss,agreement,ceiling,regions,true_regions\n");
  for (const neural::StudyOutcome& outcome : result.outcomes) {
    fmt::print("{},{:.6g},{:.4f},{:.4f},{:.2f},{:.2f}\n", to_string(outcome.representation),
               outcome.loss.back(), mean(outcome.agreement), mean(outcome.ceiling),
               mean(outcome.regions), mean(result.true_regions));
  }
}

/// Seconds that are left after each epoch, of which the first may come late, where a study goes on.
class TimeLeft {
 public:
  explicit TimeLeft(int epochs) : epochs_(epochs) {}
  double operator()(int epoch) {
    if (before_ < 0) before_ = epoch - 1;
    const std::chrono::duration<double> elapsed = Clock::now() - start_;
    return elapsed.count() * (epochs_ - epoch) / (epoch - before_);
  }

 private:
  int epochs_, before_ = -1;
  Clock::time_point start_ = Clock::now();
};

void say_time(const StudyArguments& a, double seconds) {
  if (a.lines) {
    fmt::print("seconds {:.9g}\n", seconds);
  } else {
    fmt::print("what there is to do takes {} (hours:minutes:seconds)\n", duration(seconds));
  }
}

int study(const StudyArguments& a, std::stop_token stop) {
  const int epochs = static_cast<int>(neural::kRepresentations.size()) * a.settings.epochs;
  Shown shown(a.lines, epochs);
  TimeLeft left(epochs);
  const training::StudyRun run{
      .threads = a.threads,
      .checkpoints = neural::study_checkpoints(a.out),
      .stop = stop,
      .progress = [&](int epoch, double loss) { shown(epoch, loss, left(epoch)); },
      .message =
          [&](std::string_view text) {
            fmt::print(a.lines ? stdout : stderr, "{} {}\n", a.lines ? "message" : kProgram, text);
            std::fflush(stdout);
          }};
  if (a.only_time) {
    say_time(a, training::study_seconds(a.settings, run));
    return kGood;
  }
  const neural::RepresentationStudy result = training::study_representations(a.settings, run);
  neural::write_representation_study(a.out, result);
  neural::remove_study_checkpoints(a.out);
  if (!a.lines) print_study(result);
  return kGood;
}

int run_program(int argc, char** argv, std::stop_token stop) {
  CLI::App app(kAbout, "fracbench-train");
  app.require_subcommand(1);
  std::function<int()> chosen;

  Arguments a;
  auto* command = app.add_subcommand("train", "Trains a network, or goes on with it");
  command
      ->add_option(
          "DATASET", a.data,
          "Data set file from 'fracbench export-learning'; several: one model for all their shapes")
      ->required();
  command->add_option("--out", a.out, "The model's file")->required();
  command->add_option("--checkpoints", a.checkpoints, "Folder (default: OUT.checkpoints)");
  const auto add_training_options = [&](CLI::App& to) {
    to.add_option("--options", a.options_file, "All options of the training, as JSON");
    to.add_option("--set", a.set, "NAME=VALUE: one of them, e.g. epochs=200, network.width=0.25");
    to.add_option("--device", a.device, "cpu or cuda; cuda:1 and so on of several")
        ->capture_default_str();
    to.add_option("--threads", a.threads, "Of the processor")->capture_default_str();
  };
  add_training_options(*command);
  command->add_flag(
      "--progress-lines", a.lines,
      "A line 'epoch DONE ALL LOSS SECONDS_LEFT' for each epoch on standard output, for a "
      "program that started this one; it stops when that ends");
  command->callback([&] { chosen = [&] { return train(a, stop); }; });

  auto* time_command = app.add_subcommand(
      "time", "Says how long a training would take, from a few steps on made-up patterns");
  add_training_options(*time_command);
  time_command->add_option("--patterns", a.patterns, "To learn from")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  time_command->add_flag("--progress-lines", a.lines,
                         "Nothing but a line 'seconds SECONDS' on standard output");
  time_command->callback([&] { chosen = [&] { return time_training(a, stop); }; });

  std::string file;
  bool losses = false;
  auto* about = app.add_subcommand("info", "Says as JSON what a model or data set file holds");
  about->add_option("FILE", file)->required();
  about->add_flag("--losses", losses, "With the loss and the time of every epoch");
  about->callback([&] { chosen = [&] { return info(file, losses); }; });

  StudyArguments two;
  auto* study_command = app.add_subcommand(
      "study-2d",
      "Learns 2D Voronoi diagrams as labels, lines and distances, and prints how well; goes on "
      "where it was stopped");
  study_command
      ->add_option("--out", two.out,
                   "The study's file, for fracbench report; check points are in OUT.checkpoints "
                   "until it is done")
      ->required();
  const auto number = [&](const char* name, auto& value, const char* text) {
    study_command->add_option(name, value, text)->capture_default_str();
  };
  number("--side", two.settings.side, "Of the images, pixels");
  number("--patterns", two.settings.patterns, "Diagrams");
  number("--least-sites", two.settings.least_sites, "Of a diagram");
  number("--most-sites", two.settings.most_sites, "Of a diagram");
  number("--epochs", two.settings.epochs, "Of each representation");
  number("--learning-rate", two.settings.learning_rate, "Of the first two thirds of them");
  number("--seed", two.settings.seed, "");
  number("--threads", two.threads, "Of the processor");
  study_command->add_flag("--progress-lines", two.lines, "As for train");
  study_command->add_flag("--time", two.only_time,
                          "Only says how long it would take to make what check points do not hold, "
                          "from some steps");
  study_command->callback([&] { chosen = [&] { return study(two, stop); }; });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kGood : kBadInput;
  }
  if (a.lines || two.lines) end_with_parent();
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  neural::use_fitting_blas_kernels(argv);
  const Interrupt interrupt;
  const auto fail = [](const char* what, int code) {
    fmt::print(stderr, "{} {}\n", kProgram, what);
    return code;
  };
  try {
    return run_program(argc, argv, interrupt.token());
  } catch (const Cancelled&) {
    return fail("stopped; the same command goes on from the last check point", kNotDone);
  } catch (const InputError& error) {
    return fail(error.what(), kBadInput);
  } catch (const training::TrainingFailure& error) {
    return fail(error.what(), kBadInput);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; a smaller width or resolution needs less", kNotDone);
  } catch (const std::exception& error) {
    return fail(error.what(), kInternal);
  }
}
