#include "harness/gates.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/options.h"
#include "core/text.h"

namespace fracbench {

namespace {

/// Both `factor` and `change` are 0 where not given.
const OptionsSchema& gate_schema() {
  static const OptionsSchema schema = {
      {"metric", "", "", "name in docs/metrics.md, or stage_* for every stage"},
      {.name = "test",
       .fallback = "mean",
       .unit = "",
       .summary = "what is compared",
       .choices = {"mean", "ks", "wasserstein", "paired-ratio"}},
      {"method", "", "", "label in the suite; all methods, each by itself, where not given"},
      {"relative_to", "", "",
       "label of a method whose time for the same collision the times are divided by"},
      {"shape", "", "", "label in the suite; all shapes together where not given"},
      {.name = "direction",
       .fallback = "both",
       .unit = "",
       .summary = "which way is a regression",
       .choices = {"both", "higher", "lower"}},
      {.name = "factor",
       .fallback = 0.0,
       .unit = "",
       .summary = "smallest ratio that matters, above 1",
       .minimum = 0,
       .maximum = 1e6},
      {.name = "change",
       .fallback = 0.0,
       .unit = "",
       .summary = "smallest difference that matters, in the metric's unit",
       .minimum = 0},
      {.name = "significance",
       .fallback = 0.01,
       .unit = "",
       .summary = "probability of a false alarm of all gates together",
       .minimum = 1e-6,
       .maximum = 0.2},
      {"raise_to_noise", false, "", "raise the limit to the baseline's noise, not refuse it"}};
  return schema;
}

OptionValue value_of(const toml::node& node, std::string_view key, const std::string& where) {
  if (const auto* v = node.as_boolean()) return v->get();
  if (const auto* v = node.as_integer()) return v->get();
  if (const auto* v = node.as_floating_point()) return v->get();
  if (const auto* v = node.as_string()) return v->get();
  throw InputError(fmt::format("{}: '{}' must be a number, text, true or false", where, key));
}

GateTest parse_test(std::string_view name) {
  if (name == "ks") return GateTest::kolmogorov_smirnov;
  if (name == "wasserstein") return GateTest::wasserstein;
  if (name == "paired-ratio") return GateTest::paired_ratio;
  return GateTest::mean;
}

void read_limit(Gate& gate, const Options& options, const std::string& where) {
  const double factor = options.number("factor");
  const double change = options.number("change");
  const bool only_factor = gate.test == GateTest::paired_ratio;
  const bool only_change =
      gate.test == GateTest::kolmogorov_smirnov || gate.test == GateTest::wasserstein;
  if (factor > 0 && change > 0) {
    throw InputError(fmt::format("{}: give either 'factor' or 'change', not both", where));
  }
  if (factor > 0 ? only_change : (change <= 0 || only_factor)) {
    throw InputError(fmt::format("{}: the test '{}' needs the smallest change that matters: {}",
                                 where, to_string(gate.test),
                                 only_factor   ? "factor = 1.25"
                                 : only_change ? "change = 0.1"
                                               : "factor = 1.1, or change = 0.1"));
  }
  if (factor > 0 && factor <= 1) {
    throw InputError(fmt::format(
        "{}: 'factor' is {}, but must be above 1; it holds for both directions (1.1: 10 % more, or "
        "less by the same ratio)",
        where, factor));
  }
  gate.relative = factor > 0;
  gate.limit = gate.relative ? factor : change;
}

Gate read_gate(const toml::table& table, const std::filesystem::path& source) {
  const auto place = [&](const toml::node& node) {
    return fmt::format("{}:{}: gate", source.string(), node.source().begin.line);
  };
  std::vector<std::string> names;
  for (const OptionSpec& spec : gate_schema()) names.push_back(spec.name);
  OptionMap given;
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    const std::string where = place(node);
    if (std::ranges::find(names, name) == names.end()) {
      throw InputError(
          fmt::format("{}: unknown key '{}'{}", where, name, did_you_mean(name, names)));
    }
    given[name] = value_of(node, name, where);
    Options(gate_schema(), {{name, given[name]}}, where);  // so that the message has its line
  }
  const std::string where = place(table);
  const Options options(gate_schema(), given, where);
  Gate gate{.metric = options.text("metric"),
            .test = parse_test(options.text("test")),
            .method = options.text("method"),
            .relative_to = options.text("relative_to"),
            .shape = options.text("shape"),
            .significance = options.number("significance"),
            .raise_to_noise = options.flag("raise_to_noise")};
  if (options.text("direction") == "higher") gate.direction = Tail::upper;
  if (options.text("direction") == "lower") gate.direction = Tail::lower;
  if (gate.metric.empty()) {
    throw InputError(
        fmt::format("{}: 'metric' is missing, such as metric = \"fragment_count\"", where));
  }
  if (gate.of_machine() != (gate.test == GateTest::paired_ratio)) {
    throw InputError(
        fmt::format("{}: the test 'paired-ratio' is for times and memory, and these "
                    "have no other; '{}' has the test '{}'",
                    where, gate.metric, to_string(gate.test)));
  }
  if (!gate.relative_to.empty() && !gate.of_machine()) {
    throw InputError(
        fmt::format("{}: 'relative_to' is for times and memory, not for '{}'", where, gate.metric));
  }
  read_limit(gate, options, where);
  return gate;
}

}  // namespace

std::string_view to_string(GateTest test) {
  switch (test) {
    case GateTest::mean:
      return "mean";
    case GateTest::kolmogorov_smirnov:
      return "ks";
    case GateTest::wasserstein:
      return "wasserstein";
    case GateTest::paired_ratio:
      return "paired-ratio";
  }
  return "";
}

bool Gate::of_machine() const {
  return metric.starts_with("stage_") || metric == "total_seconds" || metric == "peak_memory";
}

std::vector<Gate> default_gates() {
  const auto mean = [](std::string metric, double limit, bool relative) {
    return Gate{.metric = std::move(metric),
                .limit = limit,
                .relative = relative,
                .raise_to_noise = true,
                .built_in = true};
  };
  const auto ratio = [](std::string metric, double limit) {
    return Gate{.metric = std::move(metric),
                .test = GateTest::paired_ratio,
                .direction = Tail::upper,
                .limit = limit,
                .relative = true,
                .raise_to_noise = true,
                .optional = true,
                .built_in = true};
  };
  return {mean("fragment_count", 1.1, true),
          {.metric = "fragment_volume",
           .test = GateTest::kolmogorov_smirnov,
           .limit = 0.1,
           .raise_to_noise = true,
           .built_in = true},
          mean("normal_along", 0.05, false),
          mean("roughness", 2, false),
          mean("volume_ratio", 1e-3, false),
          ratio("total_seconds", 1.5),
          ratio("stage_*", 2)};
}

std::vector<Gate> parse_gates(std::string_view text, const std::filesystem::path& source) {
  toml::table table;
  try {
    table = toml::parse(text, source.string());
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: {}", source.string(), error.source().begin.line, error.description()));
  }
  std::vector<Gate> gates;
  const std::vector<std::string> known = {"gate"};
  for (const auto& [key, node] : table) {
    if (key.str() != "gate") {
      throw InputError(fmt::format("{}:{}: unknown key '{}'{}", source.string(),
                                   node.source().begin.line, key.str(),
                                   did_you_mean(key.str(), known)));
    }
    const toml::array* list = node.as_array();
    if (!list || !list->is_homogeneous<toml::table>()) {
      throw InputError(fmt::format("{}:{}: 'gate' must be a list of tables: write [[gate]]",
                                   source.string(), node.source().begin.line));
    }
    for (const toml::node& item : *list) gates.push_back(read_gate(*item.as_table(), source));
  }
  if (gates.empty()) {
    throw InputError(
        fmt::format("{}: holds no gates, so that nothing could fail; write [[gate]] and metric = "
                    "\"fragment_count\", or leave out --gates",
                    source.string()));
  }
  return gates;
}

std::vector<Gate> read_gates(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) {
    throw InputError(fmt::format("{}: the gates cannot be read", file.string()));
  }
  return parse_gates(text.str(), file);
}

}  // namespace fracbench
