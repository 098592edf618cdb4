#include "harness/suite_overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace fracbench {

namespace {

constexpr std::string_view kWhere = "--set";

const std::vector<std::string>& suite_keys() {
  static const std::vector<std::string> keys = {
      "seed",      "repeats",           "threads_per_cell", "warm_up",  "device", "timeout_s",
      "memory_mb", "prepare_timeout_s", "method",           "scenario", "shape",  "learning",
      "study"};
  return keys;
}

bool is_limit(std::string_view key) {
  return std::ranges::find(limits_schema(), key, &OptionSpec::name) != limits_schema().end();
}

void set_limit(SuiteMethod& method, std::string_view key, std::string_view text,
               std::string_view where) {
  const OptionValue value = parse_option(limits_schema(), key, text, where);
  method.limits = with_limits(method.limits, {{std::string(key), value}}, where);
}

Options replaced(const Options& options, const OptionsSchema& schema, std::string_view option,
                 std::string_view text, std::string_view where) {
  OptionMap values = options.values();
  values[std::string(option)] = parse_option(schema, option, text, where);
  return Options(schema, values, where);
}

/// Calls `change` for the entries that `label` names.
template <typename Entries, typename Change>
void change_entries(Entries& entries, std::string_view kind, std::string_view label,
                    const Change& change) {
  bool found = false;
  std::vector<std::string> labels;
  for (auto& entry : entries) {
    labels.push_back(entry.label);
    if (label != "*" && label != entry.label) continue;
    found = true;
    change(entry, fmt::format("{} {}.{}", kWhere, kind, entry.label));
  }
  if (!found) {
    throw InputError(fmt::format("{}: the suite has no {} '{}'{}", kWhere, kind, label,
                                 did_you_mean(label, labels)));
  }
}

bool is_top_value(std::string_view key) {
  constexpr std::array kKeys = {"seed", "repeats", "threads_per_cell", "warm_up", "device"};
  return std::ranges::find(kKeys, key) != kKeys.end();
}

void set_top_value(Suite& suite, std::string_view key, std::string_view text) {
  const OptionValue value = parse_option(suite_schema(), key, text, kWhere);
  if (key == "device") {
    suite.device = std::get<std::string>(value);
    return;
  }
  const std::int64_t number = std::get<std::int64_t>(value);
  if (key == "seed") suite.seed = static_cast<std::uint64_t>(number);
  if (key == "repeats") suite.repeats = static_cast<int>(number);
  if (key == "threads_per_cell") suite.threads_per_cell = static_cast<int>(number);
  if (key == "warm_up") suite.warm_up = static_cast<int>(number);
}

void set_shape_value(SuiteShape& shape, std::string_view option, std::string_view text,
                     std::string_view where) {
  const OptionValue value = parse_option(shape_schema(), option, text, where);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    shape.request.resolution = static_cast<int>(*whole);
  } else {
    shape.request.longest_side = std::get<double>(value);
  }
}

/// `key` is what follows "learning.".
void set_learning_value(SuiteLearning& learning, std::string_view key, std::string_view text,
                        const Catalog& catalog) {
  const std::string where = fmt::format("{} learning", kWhere);
  const std::size_t dot = key.find('.');
  const std::string_view part = key.substr(0, dot);
  if (key == "count" || (part == "scenario" && dot != key.npos)) {
    const OptionsSchema schema = catalog.family(learning.scenario.family, where).options();
    learning.scenario.options = replaced(learning.scenario.options, schema,
                                         dot == key.npos ? key : key.substr(dot + 1), text, where);
  } else if (part == "options" && dot != key.npos) {
    const OptionsSchema schema = catalog.method(learning.method.name, where).options();
    learning.method.options =
        replaced(learning.method.options, schema, key.substr(dot + 1), text, where);
  } else if (is_limit(key)) {
    set_limit(learning.method, key, text, where);
  } else {
    const OptionValue value = parse_option(learning_schema(), key, text, where);
    const std::int64_t number = std::get<std::int64_t>(value);
    if (key == "seed") learning.seed = static_cast<std::uint64_t>(number);
    if (key == "threads") learning.threads = static_cast<int>(number);
    if (key == "train") learning.split.train = static_cast<int>(number);
    if (key == "test") learning.split.test = static_cast<int>(number);
    if (key == "least") learning.split.least = static_cast<int>(number);
  }
}

}  // namespace

Suite with_override(Suite suite, std::string_view assignment, const Catalog& catalog) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw InputError(fmt::format("{} {}: must be key=value, such as seed=7 or method.cvd.sites=40",
                                 kWhere, assignment));
  }
  const std::string_view key = assignment.substr(0, equals);
  const std::string_view text = assignment.substr(equals + 1);
  if (is_top_value(key)) {
    set_top_value(suite, key, text);
    return suite;
  }
  if (is_limit(key)) {
    for (SuiteMethod& method : suite.methods) set_limit(method, key, text, kWhere);
    if (suite.learning) set_limit(suite.learning->method, key, text, kWhere);
    return suite;
  }
  constexpr std::string_view kLearning = "learning.";
  if (key.starts_with(kLearning)) {
    if (!suite.learning) {
      throw InputError(fmt::format("{} {}: the suite has no table [learning]", kWhere, assignment));
    }
    set_learning_value(*suite.learning, key.substr(kLearning.size()), text, catalog);
    check_labels(suite, kWhere);
    return suite;
  }
  constexpr std::string_view kStudy = "study.";
  if (key.starts_with(kStudy)) {
    if (!suite.study) {
      throw InputError(fmt::format("{} {}: the suite has no table [study]", kWhere, assignment));
    }
    suite.study = replaced(*suite.study, study_schema(), key.substr(kStudy.size()), text, kWhere);
    return suite;
  }
  // A label may hold dots, the names of kinds and options never do.
  const std::size_t first = key.find('.');
  const std::size_t last = key.rfind('.');
  const std::string_view kind = key.substr(0, first);
  if (kind != "method" && kind != "scenario" && kind != "shape") {
    throw InputError(fmt::format("{} {}: unknown key '{}'{}", kWhere, assignment, kind,
                                 did_you_mean(kind, suite_keys())));
  }
  if (first == last) {
    throw InputError(fmt::format("{} {}: name the {} and its option, as in {}.LABEL.OPTION=value",
                                 kWhere, assignment, kind, kind));
  }
  const std::string_view label = key.substr(first + 1, last - first - 1);
  const std::string_view option = key.substr(last + 1);
  if (kind == "method") {
    change_entries(suite.methods, kind, label, [&](SuiteMethod& method, const std::string& where) {
      if (is_limit(option)) return set_limit(method, option, text, where);
      const OptionsSchema schema = catalog.method(method.name, where).options();
      method.options = replaced(method.options, schema, option, text, where);
    });
  } else if (kind == "scenario") {
    change_entries(suite.scenarios, kind, label,
                   [&](SuiteScenario& scenario, const std::string& where) {
                     const OptionsSchema schema = catalog.family(scenario.family, where).options();
                     scenario.options = replaced(scenario.options, schema, option, text, where);
                   });
  } else {
    change_entries(suite.shapes, kind, label, [&](SuiteShape& shape, const std::string& where) {
      set_shape_value(shape, option, text, where);
    });
  }
  return suite;
}

Suite at_scale(Suite suite, std::string_view scale, const Catalog& catalog) {
  const auto found = std::ranges::find(suite.scales, scale, &SuiteScale::name);
  if (found == suite.scales.end()) {
    std::vector<std::string> names;
    for (const SuiteScale& known : suite.scales) names.push_back(known.name);
    throw InputError(fmt::format(
        "--scale {}: the suite '{}' {}", scale, suite.name,
        names.empty() ? "has no other scale" : "does not have it" + did_you_mean(scale, names)));
  }
  const SuiteScale chosen = *found;
  suite.name += "-" + chosen.name;
  suite.scales.clear();
  if (!chosen.summary.empty()) suite.summary = chosen.summary;
  if (!chosen.shapes.empty()) {
    suite.shapes = chosen.shapes;
    // What was limited to shapes of the smaller scale breaks all of those of this one.
    for (SuiteMethod& method : suite.methods) method.shapes.clear();
    if (suite.learning) suite.learning->shapes.clear();
  }
  for (const std::string& setting : chosen.settings) {
    try {
      suite = with_override(std::move(suite), setting, catalog);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: scale '{}': {}", suite.name, chosen.name, error.what()));
    }
  }
  check_labels(suite, suite.name);
  return suite;
}

}  // namespace fracbench
