#include "harness/suite_reader.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace fracbench {

namespace {

/// A table of the file, and how to name it in messages.
struct Entry {
  const toml::table& table;
  std::filesystem::path source;
  std::string what;  ///< "method 'cvd'"; empty for the top of the file

  std::string where(const toml::node& node) const {
    std::string place = fmt::format("{}:{}", source.string(), node.source().begin.line);
    return what.empty() ? place : fmt::format("{}: {}", place, what);
  }
  std::string where() const { return where(table); }
};

OptionValue option_value(const toml::node& node, std::string_view key, const std::string& where) {
  if (const auto* v = node.as_boolean()) return v->get();
  if (const auto* v = node.as_integer()) return v->get();
  if (const auto* v = node.as_floating_point()) return v->get();
  if (const auto* v = node.as_string()) return v->get();
  if (const auto* array = node.as_array()) {
    std::vector<double> list;
    for (const toml::node& item : *array) {
      const auto number = item.is_number() ? item.value<double>() : std::nullopt;
      if (!number) throw InputError(fmt::format("{}: '{}' must hold only numbers", where, key));
      list.push_back(*number);
    }
    return list;
  }
  throw InputError(
      fmt::format("{}: '{}' must be a number, text, true, false or a list of numbers", where, key));
}

/// The options of a table whose other keys are `reserved`.
Options read_options(const Entry& entry, const OptionsSchema& schema,
                     const std::vector<std::string>& reserved) {
  OptionMap given;
  for (const auto& [key, node] : entry.table) {
    const std::string name(key.str());
    if (std::ranges::find(reserved, name) != reserved.end()) continue;
    const std::string where = entry.where(node);
    const bool known = std::ranges::find(schema, name, &OptionSpec::name) != schema.end();
    if (!known) {
      std::vector<std::string> names = reserved;
      for (const OptionSpec& spec : schema) names.push_back(spec.name);
      throw InputError(
          fmt::format("{}: unknown key '{}'{}", where, name, did_you_mean(name, names)));
    }
    given[name] = option_value(node, name, where);
    // One at a time, so that the message has the line of the option and not that of the table.
    Options(schema, {{name, given[name]}}, where);
  }
  return Options(schema, given, entry.where());
}

/// Which keys of the table are limits, checked one by one.
OptionMap read_limits(const Entry& entry) {
  OptionMap given;
  for (const OptionSpec& spec : limits_schema()) {
    const toml::node* node = entry.table.get(spec.name);
    if (!node) continue;
    const std::string where = entry.where(*node);
    given[spec.name] = option_value(*node, spec.name, where);
    with_limits({}, {{spec.name, given[spec.name]}}, where);
  }
  return given;
}

/// `keys`, and those of the limits.
std::vector<std::string> and_limits(std::vector<std::string> keys) {
  for (const OptionSpec& spec : limits_schema()) keys.push_back(spec.name);
  return keys;
}

std::optional<std::string> read_text(const Entry& entry, std::string_view key) {
  const toml::node* node = entry.table.get(key);
  if (!node) return std::nullopt;
  if (const auto* text = node->as_string()) return text->get();
  throw InputError(fmt::format("{}: '{}' must be text", entry.where(*node), key));
}

std::string require_text(const Entry& entry, std::string_view key, std::string_view example) {
  const auto text = read_text(entry, key);
  if (text && !text->empty()) return *text;
  throw InputError(
      fmt::format("{}: '{}' is missing, such as {} = \"{}\"", entry.where(), key, key, example));
}

/// The tables [[kind]] of the file.
std::vector<Entry> read_entries(const Entry& top, std::string_view kind) {
  const toml::node* node = top.table.get(kind);
  if (!node) return {};
  const toml::array* array = node->as_array();
  std::vector<Entry> entries;
  if (array) {
    for (const toml::node& item : *array) {
      if (const toml::table* table = item.as_table()) {
        entries.push_back({*table, top.source, std::string(kind)});
      }
    }
  }
  if (!array || entries.size() != array->size()) {
    throw InputError(fmt::format("{}: '{}' must be a list of tables: write [[{}]]",
                                 top.where(*node), kind, kind));
  }
  return entries;
}

SuiteShape make_shape(const std::string& name, const Options& options) {
  SuiteShape shape;
  shape.label = names_a_file(name) ? std::filesystem::path(name).stem().string() : name;
  shape.request.name = name;
  shape.request.resolution = static_cast<int>(options.integer("resolution"));
  shape.request.longest_side = options.number("longest_side");
  return shape;
}

std::vector<SuiteShape> read_shapes(const Entry& top) {
  std::vector<SuiteShape> shapes;
  if (const toml::node* node = top.table.get("shapes")) {
    const toml::array* names = node->as_array();
    if (!names) {
      throw InputError(
          fmt::format("{}: 'shapes' must be a list of names, such as [\"pot\"]", top.where(*node)));
    }
    const Options defaults(shape_schema(), {}, top.where(*node));
    for (const toml::node& item : *names) {
      const auto* name = item.as_string();
      if (!name) {
        throw InputError(fmt::format("{}: 'shapes' must hold only names", top.where(item)));
      }
      shapes.push_back(make_shape(name->get(), defaults));
    }
  }
  for (Entry& entry : read_entries(top, "shape")) {
    const std::string name = require_text(entry, "name", "pot");
    entry.what = fmt::format("shape '{}'", name);
    const Options options = read_options(entry, shape_schema(), {"name", "label"});
    shapes.push_back(make_shape(name, options));
    if (const auto label = read_text(entry, "label")) shapes.back().label = *label;
  }
  return shapes;
}

std::vector<SuiteScenario> read_scenarios(const Entry& top, const Catalog& catalog) {
  std::vector<SuiteScenario> scenarios;
  for (Entry& entry : read_entries(top, "scenario")) {
    const std::string family = require_text(entry, "family", "single");
    const ScenarioFamily& known = catalog.family(family, entry.where(*entry.table.get("family")));
    entry.what = fmt::format("scenario '{}'", family);
    scenarios.push_back({.label = read_text(entry, "label").value_or(family),
                         .family = family,
                         .options = read_options(entry, known.options(), {"family", "label"})});
  }
  return scenarios;
}

std::vector<std::string> read_names(const Entry& entry, std::string_view key) {
  std::vector<std::string> names;
  const toml::node* node = entry.table.get(key);
  if (!node) return names;
  const toml::array* array = node->as_array();
  if (array) {
    for (const toml::node& item : *array) {
      if (const auto* name = item.as_string()) names.push_back(name->get());
    }
  }
  if (!array || names.size() != array->size()) {
    throw InputError(fmt::format("{}: '{}' must be a list of names", entry.where(*node), key));
  }
  return names;
}

std::vector<SuiteMethod> read_methods(const Entry& top, const Catalog& catalog) {
  std::vector<SuiteMethod> methods;
  const CellLimits limits = with_limits({}, read_limits(top), top.where());
  for (Entry& entry : read_entries(top, "method")) {
    const std::string name = require_text(entry, "name", "cvd");
    const Method& known = catalog.method(name, entry.where(*entry.table.get("name")));
    entry.what = fmt::format("method '{}'", name);
    methods.push_back(
        {.label = read_text(entry, "label").value_or(name),
         .name = name,
         .options = read_options(entry, known.options(),
                                 and_limits({"name", "label", "shapes", "learn_with"})),
         .limits = with_limits(limits, read_limits(entry), entry.where()),
         .shapes = read_names(entry, "shapes"),
         .learn_with = read_names(entry, "learn_with")});
    if (!methods.back().learn_with.empty() && !known.info().learns_several) {
      throw InputError(
          fmt::format("{}: it does not learn several shapes at once; remove learn_with",
                      entry.where(*entry.table.get("learn_with"))));
    }
  }
  return methods;
}

/// The options in the table `key` of another table, which may be missing.
Options read_part(const Entry& entry, std::string_view key, const std::string& whose,
                  const OptionsSchema& schema) {
  const toml::node* node = entry.table.get(key);
  if (!node) return Options(schema, {}, entry.where());
  const toml::table* table = node->as_table();
  if (!table) {
    throw InputError(
        fmt::format("{}: '{}' must be a table: write [learning.{}]", entry.where(*node), key, key));
  }
  return read_options({*table, entry.source, whose}, schema, {});
}

/// The tables [scale.NAME].
std::vector<SuiteScale> read_scales(const Entry& top) {
  std::vector<SuiteScale> scales;
  const toml::node* node = top.table.get("scale");
  if (!node) return scales;
  const toml::table* all = node->as_table();
  if (!all) {
    throw InputError(
        fmt::format("{}: 'scale' must hold tables: write [scale.paper]", top.where(*node)));
  }
  for (const auto& [key, value] : *all) {
    const toml::table* table = value.as_table();
    if (!table) {
      throw InputError(fmt::format("{}: 'scale.{}' must be a table", top.where(value), key.str()));
    }
    const Entry entry{*table, top.source, fmt::format("scale '{}'", key.str())};
    read_options(entry, {}, {"summary", "shapes", "set"});
    scales.push_back({.name = std::string(key.str()),
                      .summary = read_text(entry, "summary").value_or(""),
                      .shapes = read_shapes(entry),
                      .settings = read_names(entry, "set")});
  }
  return scales;
}

/// The table [name], which stands once; null where it is missing.
const toml::table* one_table(const Entry& top, std::string_view name) {
  const toml::node* node = top.table.get(name);
  if (!node) return nullptr;
  if (const toml::table* table = node->as_table()) return table;
  throw InputError(
      fmt::format("{}: '{}' must be one table: write [{}]", top.where(*node), name, name));
}

std::optional<Options> read_study(const Entry& top) {
  const toml::table* table = one_table(top, "study");
  if (!table) return std::nullopt;
  return read_options({*table, top.source, "study"}, study_schema(), {});
}

std::optional<SuiteLearning> read_learning(const Entry& top, const Catalog& catalog) {
  const toml::table* table = one_table(top, "learning");
  if (!table) return std::nullopt;
  const Entry entry{*table, top.source, "learning"};
  const std::string name = require_text(entry, "method", "bem");
  const std::string family = require_text(entry, "family", "single");
  const Method& method = catalog.method(name, entry.where(*table->get("method")));
  const ScenarioFamily& known = catalog.family(family, entry.where(*table->get("family")));
  const Options values =
      read_options(entry, learning_schema(),
                   and_limits({"method", "family", "shapes", "count", "options", "scenario"}));
  Options scenario =
      read_part(entry, "scenario", fmt::format("learning: scenario '{}'", family), known.options());
  if (const toml::node* count = table->get("count")) {
    OptionMap all = scenario.values();
    all["count"] = option_value(*count, "count", entry.where(*count));
    scenario = Options(known.options(), all, entry.where(*count));
  }
  CellLimits limits = with_limits({}, read_limits(top), top.where());
  limits = with_limits(limits, read_limits(entry), entry.where());
  return SuiteLearning{
      .method = {.label = name,
                 .name = name,
                 .options = read_part(entry, "options", fmt::format("learning: method '{}'", name),
                                      method.options()),
                 .limits = limits},
      .scenario = {.label = family, .family = family, .options = scenario},
      .shapes = read_names(entry, "shapes"),
      .seed = static_cast<std::uint64_t>(values.integer("seed")),
      .threads = static_cast<int>(values.integer("threads")),
      .split = {.train = static_cast<int>(values.integer("train")),
                .test = static_cast<int>(values.integer("test")),
                .least = static_cast<int>(values.integer("least"))}};
}

}  // namespace

Suite parse_suite(std::string_view text, const std::filesystem::path& source,
                  const Catalog& catalog) {
  toml::table table;
  try {
    table = toml::parse(text, source.string());
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: {}", source.string(), error.source().begin.line, error.description()));
  }
  const Entry top{table, source, ""};
  const Options values = read_options(
      top, suite_schema(),
      and_limits({"shape", "shapes", "scenario", "method", "learning", "study", "scale"}));
  Suite suite;
  suite.folder = source.parent_path();
  suite.name = values.text("name").empty() ? source.stem().string() : values.text("name");
  suite.summary = values.text("summary");
  suite.seed = static_cast<std::uint64_t>(values.integer("seed"));
  suite.repeats = static_cast<int>(values.integer("repeats"));
  suite.threads_per_cell = static_cast<int>(values.integer("threads_per_cell"));
  suite.device = values.text("device");
  suite.warm_up = static_cast<int>(values.integer("warm_up"));
  suite.shapes = read_shapes(top);
  suite.scenarios = read_scenarios(top, catalog);
  suite.methods = read_methods(top, catalog);
  suite.learning = read_learning(top, catalog);
  suite.study = read_study(top);
  suite.scales = read_scales(top);
  check_labels(suite, source.string());
  return suite;
}

Suite read_suite(const std::filesystem::path& file, const Catalog& catalog) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.good()) {
    throw InputError(fmt::format("{}: the suite cannot be read", file.string()));
  }
  return parse_suite(text, file, catalog);
}

}  // namespace fracbench
