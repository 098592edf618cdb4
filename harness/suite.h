#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/options.h"
#include "scenarios/shapes.h"

namespace fracbench {

struct SuiteShape {
  std::string label;  ///< unique in the suite
  ShapeRequest request;
};

struct SuiteScenario {
  std::string label;  ///< unique in the suite
  std::string family;
  Options options;
};

struct SuiteMethod {
  std::string label;  ///< unique in the suite
  std::string name;   ///< in the registry
  Options options;
};

/// What is to be measured: every shape in every scenario with every method, each `repeats` times.
/// Complete and checked: every option has its value.
struct Suite {
  std::string name;
  std::string summary;
  std::uint64_t seed = 1;
  int repeats = 1;           ///< with the same impacts and other random numbers for the method
  int threads_per_cell = 1;  ///< part of what determines a result, see docs/records.md
  std::vector<SuiteShape> shapes;
  std::vector<SuiteScenario> scenarios;
  std::vector<SuiteMethod> methods;
};

/// Everything that determines the suite's results, defaults included; the summary does not.
nlohmann::ordered_json to_json(const Suite& suite);

/// The values of a suite that stand at its top, and those of a shape: names, units, defaults,
/// ranges.
const OptionsSchema& suite_schema();
const OptionsSchema& shape_schema();

/// Throws InputError for a suite without shapes, scenarios or methods, and for labels that are
/// used twice or hold anything but letters, digits and ". _ + -".
void check_labels(const Suite& suite, std::string_view where);

}  // namespace fracbench
