#include "harness/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "neural/representation_study.h"

namespace fracbench {

namespace {

constexpr std::string_view kLabelCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._+-";

template <typename Entries>
void check_entries(const Entries& entries, std::string_view kind, std::string_view where) {
  if (entries.empty()) {
    throw InputError(
        fmt::format("{}: the suite has no {}; add at least one [[{}]]", where, kind, kind));
  }
  std::set<std::string> seen;
  for (const auto& entry : entries) {
    if (entry.label.empty() ||
        entry.label.find_first_not_of(kLabelCharacters) != std::string::npos) {
      throw InputError(fmt::format(
          "{}: the {} label '{}' may hold only letters, digits and . _ + -; give it a label = ...",
          where, kind, entry.label));
    }
    if (!seen.insert(entry.label).second) {
      throw InputError(
          fmt::format("{}: two entries [[{}]] are called '{}'; give each a label = ... of its own",
                      where, kind, entry.label));
    }
  }
}

nlohmann::ordered_json learning_json(const SuiteLearning& learning) {
  return {{"method", learning.method.name},     {"options", learning.method.options.to_json()},
          {"family", learning.scenario.family}, {"scenario", learning.scenario.options.to_json()},
          {"shapes", learning.shapes},          {"seed", learning.seed},
          {"threads", learning.threads},        {"train", learning.split.train},
          {"test", learning.split.test},        {"least", learning.split.needed()}};
}

void check_shapes(const Suite& suite, const std::vector<std::string>& labels,
                  std::string_view where) {
  std::vector<std::string> known;
  for (const SuiteShape& shape : suite.shapes) known.push_back(shape.label);
  for (const std::string& label : labels) {
    if (std::ranges::find(known, label) == known.end()) {
      throw InputError(fmt::format("{}: the suite has no shape '{}'{}", where, label,
                                   did_you_mean(label, known)));
    }
  }
}

void check_learning(const Suite& suite, std::string_view where) {
  const SuiteLearning& learning = *suite.learning;
  check_shapes(suite, learning.shapes, fmt::format("{}: learning", where));
  if (learning.split.needed() > learning.split.wanted()) {
    throw InputError(
        fmt::format("{}: learning: least is {}, more than the {} of train and test together", where,
                    learning.split.least, learning.split.wanted()));
  }
}

}  // namespace

bool SuiteMethod::breaks(std::string_view shape) const {
  return shapes.empty() || std::ranges::find(shapes, shape) != shapes.end();
}

nlohmann::ordered_json to_json(const Suite& suite) {
  using Json = nlohmann::ordered_json;
  Json json{{"name", suite.name},
            {"seed", suite.seed},
            {"repeats", suite.repeats},
            {"threads_per_cell", suite.threads_per_cell}};
  // The common case is left out, as it was before there was another one.
  if (suite.device != kProcessor) json["device"] = suite.device;
  Json& shapes = json["shapes"] = Json::object();
  for (const SuiteShape& shape : suite.shapes) {
    shapes[shape.label] = {{"name", shape.request.name},
                           {"resolution", shape.request.resolution},
                           {"longest_side", shape.request.longest_side}};
  }
  Json& scenarios = json["scenarios"] = Json::object();
  for (const SuiteScenario& scenario : suite.scenarios) {
    scenarios[scenario.label] = {{"family", scenario.family},
                                 {"options", scenario.options.to_json()}};
  }
  Json& methods = json["methods"] = Json::object();
  for (const SuiteMethod& method : suite.methods) {
    Json& entry =
        methods[method.label] = {{"name", method.name}, {"options", method.options.to_json()}};
    if (!method.shapes.empty()) entry["shapes"] = method.shapes;
    if (!method.learn_with.empty()) entry["learn_with"] = method.learn_with;
  }
  if (suite.learning) json["learning"] = learning_json(*suite.learning);
  if (suite.study) json["study"] = suite.study->to_json();
  return json;
}

std::filesystem::path find_suite_input(const Suite& suite, const std::string& name) {
  constexpr std::string_view kShapes = "$FRACBENCH_SHAPES/";
  if (name.starts_with(kShapes)) {
    const char* folder = std::getenv("FRACBENCH_SHAPES");
    return folder != nullptr ? std::filesystem::path(folder) / name.substr(kShapes.size())
                             : std::filesystem::path(name);
  }
  const std::filesystem::path beside = suite.folder / name;
  return !name.empty() && std::filesystem::exists(beside) ? beside : std::filesystem::path(name);
}

bool names_a_file(std::string_view shape) {
  return shape.find_first_of("./") != std::string_view::npos;
}

const OptionsSchema& suite_schema() {
  static const OptionsSchema schema = {
      {.name = "name",
       .fallback = std::string(),
       .unit = "",
       .summary = "what the suite is called"},
      {.name = "summary", .fallback = std::string(), .unit = "", .summary = "one line"},
      {.name = "seed",
       .fallback = std::int64_t{1},
       .unit = "",
       .summary = "all random numbers follow from it",
       .minimum = 0},
      {.name = "repeats",
       .fallback = std::int64_t{1},
       .unit = "",
       .summary = "runs of each method on each impact",
       .minimum = 1,
       .maximum = 1e6},
      {.name = "threads_per_cell",
       .fallback = std::int64_t{1},
       .unit = "threads",
       .summary = "that one cell may use",
       .minimum = 1,
       .maximum = 1024},
      {.name = "device",
       .fallback = std::string(kProcessor),
       .unit = "",
       .summary = "that methods compute on, where they can use one: deepfracture for its training",
       .choices = {std::string(kProcessor), "cuda"}},
      {.name = "warm_up",
       .fallback = std::int64_t{0},
       .unit = "",
       .summary = "runs that are thrown away each time a body was prepared",
       .minimum = 0,
       .maximum = 1000},
  };
  return schema;
}

const OptionsSchema& learning_schema() {
  constexpr double kMost = 1e6;
  static const OptionsSchema schema = {
      {.name = "train",
       .fallback = std::int64_t{LearningSplit{}.train},
       .unit = "",
       .summary = "collisions of each shape to learn from, of those that broke it",
       .minimum = 1,
       .maximum = kMost},
      {.name = "test",
       .fallback = std::int64_t{LearningSplit{}.test},
       .unit = "",
       .summary = "collisions of each shape that are kept for tests",
       .minimum = 0,
       .maximum = kMost},
      {.name = "least",
       .fallback = std::int64_t{LearningSplit{}.least},
       .unit = "",
       .summary = "how few broken ones will do, divided in proportion; 0: train and test together",
       .minimum = 0,
       .maximum = 2 * kMost},
      {.name = "threads",
       .fallback = std::int64_t{1},
       .unit = "threads",
       .summary = "that one collision may use",
       .minimum = 1,
       .maximum = 1024},
      {.name = "seed",
       .fallback = std::int64_t{0},
       .unit = "",
       .summary = "of the collisions; 0: derived from the suite's",
       .minimum = 0},
  };
  return schema;
}

const OptionsSchema& study_schema() {
  using neural::StudySettings;
  static const OptionsSchema schema = {
      {.name = "kind",
       .fallback = std::string("representations"),
       .unit = "",
       .summary = "representations: 2D Voronoi diagrams as labels, lines and distances",
       .choices = {"representations"}},
      {.name = "side",
       .fallback = std::int64_t{StudySettings{}.side},
       .unit = "pixels",
       .summary = "of the images, a power of two",
       .minimum = 8,
       .maximum = 1024},
      {.name = "patterns",
       .fallback = std::int64_t{StudySettings{}.patterns},
       .unit = "",
       .summary = "diagrams, which the network learns by heart",
       .minimum = 1,
       .maximum = 1e6},
      {.name = "least_sites",
       .fallback = std::int64_t{StudySettings{}.least_sites},
       .unit = "",
       .summary = "of a diagram",
       .minimum = 2,
       .maximum = 1e4},
      {.name = "most_sites",
       .fallback = std::int64_t{StudySettings{}.most_sites},
       .unit = "",
       .summary = "of a diagram",
       .minimum = 2,
       .maximum = 1e4},
      {.name = "epochs",
       .fallback = std::int64_t{StudySettings{}.epochs},
       .unit = "",
       .summary = "of the training of each representation",
       .minimum = 1,
       .maximum = 1e6},
      {.name = "learning_rate",
       .fallback = StudySettings{}.learning_rate,
       .unit = "",
       .summary = "of the first two thirds of the epochs; then a sixth of it",
       .minimum = 1e-9,
       .maximum = 1},
  };
  return schema;
}

const OptionsSchema& limits_schema() {
  static const OptionsSchema schema = {
      {.name = "timeout_s",
       .fallback = CellLimits{}.timeout_s,
       .unit = "s",
       .summary = "that a cell may take once its body is prepared; 0: any time",
       .minimum = 0},
      {.name = "prepare_timeout_s",
       .fallback = CellLimits{}.prepare_timeout_s,
       .unit = "s",
       .summary = "that preparing a body may take; 0: any time",
       .minimum = 0},
      {.name = "memory_mb",
       .fallback = CellLimits{}.memory_mb,
       .unit = "MiB",
       .summary = "that the process of a cell may take; 0: what the machine has",
       .minimum = 0},
  };
  return schema;
}

CellLimits with_limits(CellLimits limits, const OptionMap& given, std::string_view where) {
  const Options checked(limits_schema(), given, where);
  for (const auto& [name, value] : given) {
    if (name == "timeout_s") limits.timeout_s = checked.number(name);
    if (name == "prepare_timeout_s") limits.prepare_timeout_s = checked.number(name);
    if (name == "memory_mb") limits.memory_mb = checked.number(name);
  }
  return limits;
}

const OptionsSchema& shape_schema() {
  static const OptionsSchema schema = {
      {.name = "resolution",
       .fallback = std::int64_t{0},
       .unit = "",
       .summary = "generated shapes: subdivisions along the longest side; 0: the shape's own",
       .minimum = 0,
       .maximum = 4096},
      {.name = "longest_side",
       .fallback = ShapeRequest{}.longest_side,
       .unit = "m",
       .summary = "of the bounding box; 0: keep the file's own scale and place",
       .minimum = 0,
       .maximum = 1000},
  };
  return schema;
}

void check_labels(const Suite& suite, std::string_view where) {
  // The results folder is called after it.
  if (suite.name.find('/') != std::string::npos || suite.name == "." || suite.name == "..") {
    throw InputError(fmt::format("{}: the name '{}' is a path; name the suite without slashes",
                                 where, suite.name));
  }
  if (suite.study) {
    if (suite.learning || !suite.shapes.empty() || !suite.scenarios.empty() ||
        !suite.methods.empty()) {
      throw InputError(
          fmt::format("{}: a suite with a table [study] has no shapes, scenarios, methods or "
                      "learning data; put them into another suite",
                      where));
    }
    return;
  }
  check_entries(suite.shapes, "shape", where);
  if (suite.learning) check_learning(suite, where);
  if (suite.learning && suite.scenarios.empty() && suite.methods.empty()) return;
  check_entries(suite.scenarios, "scenario", where);
  check_entries(suite.methods, "method", where);
  for (const SuiteMethod& method : suite.methods) {
    const std::string what = fmt::format("{}: method '{}'", where, method.label);
    check_shapes(suite, method.shapes, what);
    check_shapes(suite, method.learn_with, what + ", learn_with");
  }
}

}  // namespace fracbench
