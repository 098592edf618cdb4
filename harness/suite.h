#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/context.h"
#include "core/options.h"
#include "scenarios/shapes.h"

namespace fracbench {

struct SuiteShape {
  std::string label;     ///< unique in the suite
  ShapeRequest request;  ///< a file is named as the suite names it, see Suite::folder
};

struct SuiteScenario {
  std::string label;  ///< unique in the suite
  std::string family;
  Options options;
};

/// What one cell may take before it is ended. 0: no limit of the suite's.
struct CellLimits {
  double timeout_s = 3600;           ///< wall clock for the scene, once the body is prepared
  double prepare_timeout_s = 86400;  ///< wall clock for preparing the body
  double memory_mb = 0;              ///< resident memory of its process, MiB; 0: what is there
  bool operator==(const CellLimits&) const = default;
};

struct SuiteMethod {
  std::string label;  ///< unique in the suite
  std::string name;   ///< in the registry
  Options options;
  CellLimits limits = {};                ///< no part of the suite's identity: see docs/records.md
  std::vector<std::string> shapes = {};  ///< labels of those that it breaks; empty: all
  /// Labels of shapes whose fractures it learns besides those of the target: one model for all.
  std::vector<std::string> learn_with = {};

  bool breaks(std::string_view shape) const;
};

/// How the collisions that broke are divided, for each shape.
struct LearningSplit {
  int train = 200;
  int test = 50;
  /// How few of them will do; fewer than train + test are divided in the same proportion. 0: all.
  int least = 0;

  int wanted() const { return train + test; }
  int needed() const { return least > 0 ? least : wanted(); }
};

/// The collisions that methods learn from: a method that breaks the suite's shapes in scenes of one
/// family. See docs/learning-data.md.
struct SuiteLearning {
  SuiteMethod method;
  SuiteScenario scenario;
  std::vector<std::string> shapes;  ///< labels of those that there is data for; empty: all
  std::uint64_t seed = 0;           ///< 0: derived from the suite's
  int threads = 1;                  ///< that a collision may use
  LearningSplit split;
};

/// The same suite at another scale, such as the paper's: see at_scale.
struct SuiteScale {
  std::string name;
  std::string summary;
  std::vector<SuiteShape> shapes;     ///< instead of the suite's; empty: those
  std::vector<std::string> settings;  ///< as for with_override, in their order
};

/// What is to be measured: every shape in every scenario with every method (but for methods that
/// name their shapes), each `repeats` times.
/// Complete and checked: every option has its value.
struct Suite {
  std::string name;
  std::string summary;
  std::uint64_t seed = 1;
  int repeats = 1;           ///< with the same impacts and other random numbers for the method
  int threads_per_cell = 1;  ///< part of what determines a result, see docs/records.md
  /// On which methods that can use one compute: "cpu" or "cuda". Part of what determines a result.
  std::string device = std::string(kProcessor);
  int warm_up = 0;  ///< runs that are thrown away after a body was prepared
  /// Where files that the suite names are looked for first. No part of the suite's identity, so
  /// that it is the same suite wherever it lies and from wherever it is run.
  std::filesystem::path folder;
  std::vector<SuiteShape> shapes;
  std::vector<SuiteScenario> scenarios;
  std::vector<SuiteMethod> methods;
  std::optional<SuiteLearning> learning = {};
  std::optional<Options> study = {};    ///< values of the table [study], see harness/study.h
  std::vector<SuiteScale> scales = {};  ///< no part of what the suite is
};

/// Everything that determines the suite's results, defaults included; the summary, the limits and
/// warm-up runs do not.
nlohmann::ordered_json to_json(const Suite& suite);

/// Where a file is that a suite names: below the user's folder of shapes where the name begins with
/// $FRACBENCH_SHAPES/, else beside the suite, else relative to the current folder.
std::filesystem::path find_suite_input(const Suite& suite, const std::string& name);

/// Whether a shape of this name is a file.
bool names_a_file(std::string_view shape);

/// The values of a suite that stand at its top, and those of a shape: names, units, defaults,
/// ranges.
const OptionsSchema& suite_schema();
const OptionsSchema& shape_schema();
/// The values at the top of the table [learning].
const OptionsSchema& learning_schema();
/// The values of the table [study].
const OptionsSchema& study_schema();
/// The members of CellLimits, which stand at the suite's top or with a method.
const OptionsSchema& limits_schema();
/// Those of `limits` that `given`, checked against the schema, has values for are replaced.
CellLimits with_limits(CellLimits limits, const OptionMap& given, std::string_view where);

/// Throws InputError for a suite without shapes, scenarios or methods (one that makes learning data
/// may have neither scenarios nor methods, one with a study has none of the three), for labels that
/// are used twice or hold anything but letters, digits and ". _ + -", for a name that is a path,
/// and for methods and learning data of shapes that the suite does not have.
void check_labels(const Suite& suite, std::string_view where);

}  // namespace fracbench
