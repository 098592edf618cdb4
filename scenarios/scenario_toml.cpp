#include "scenarios/scenario_toml.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/options.h"
#include "core/text.h"
#include "scenarios/scenario_options.h"

namespace fracbench {

namespace {

std::string place(const std::filesystem::path& file, const toml::node& node) {
  return fmt::format("{}:{}", file.string(), node.source().begin.line);
}

OptionValue to_option(const toml::node& node, std::string_view key, const std::string& where) {
  if (const auto* value = node.as_boolean()) return value->get();
  if (const auto* value = node.as_integer()) return std::int64_t{value->get()};
  if (const auto* value = node.as_floating_point()) return value->get();
  if (const auto* value = node.as_string()) return value->get();
  if (const auto* list = node.as_array()) {
    std::vector<double> numbers;
    for (const toml::node& item : *list) {
      const std::optional<double> number = item.value<double>();
      if (!number || !item.is_number()) break;
      numbers.push_back(*number);
    }
    if (numbers.size() == list->size()) return numbers;
  }
  throw InputError(fmt::format(
      "{}: '{}' must be a number, text, true or false, or a list of numbers", where, key));
}

/// The values of a table for a schema, each checked at its own line. `others` are keys that are
/// read elsewhere.
Options read_options(const toml::table& table, OptionsSchema schema,
                     const std::vector<std::string>& others, const std::filesystem::path& file) {
  std::vector<std::string> names = others;
  for (const OptionSpec& spec : schema) names.push_back(spec.name);
  OptionMap given;
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    const std::string where = place(file, node);
    if (std::ranges::find(names, name) == names.end()) {
      throw InputError(
          fmt::format("{}: unknown key '{}'{}", where, name, did_you_mean(name, names)));
    }
    if (std::ranges::find(others, name) != others.end()) continue;
    const OptionValue value = to_option(node, name, where);
    (void)Options(schema, {{name, value}}, where);
    given.emplace(name, value);
  }
  return Options(schema, given, file.string());
}

Vec3 to_vector(const Options& options, std::string_view name, const std::string& where) {
  const std::vector<double>& numbers = options.numbers(name);
  if (numbers.size() != 3) {
    throw InputError(fmt::format("{}: '{}' must be three numbers: [x, y, z]", where, name));
  }
  return {numbers[0], numbers[1], numbers[2]};
}

Ball read_ball(const toml::table& table, const std::filesystem::path& file) {
  const Ball fallback;
  OptionsSchema schema = material_options(fallback.material, "the ball");
  schema.push_back({.name = "position",
                    .fallback = std::vector<double>{},
                    .unit = "m",
                    .summary = "centre at the start",
                    .minimum = -1e4,
                    .maximum = 1e4});
  schema.push_back({.name = "velocity",
                    .fallback = std::vector<double>{},
                    .unit = "m/s",
                    .summary = "at the start",
                    .minimum = -1e4,
                    .maximum = 1e4});
  schema.push_back({.name = "radius",
                    .fallback = fallback.radius,
                    .unit = "m",
                    .summary = "radius",
                    .minimum = 1e-3,
                    .maximum = 10});
  const Options options = read_options(table, schema, {}, file);
  const std::string where = place(file, table);
  return {.position = to_vector(options, "position", where),
          .velocity = to_vector(options, "velocity", where),
          .radius = options.number("radius"),
          .material = material_from(options)};
}

}  // namespace

Scenario read_scenario(const std::filesystem::path& file) {
  toml::table document;
  try {
    document = toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    if (error.source().begin.line == 0) {
      throw InputError(
          fmt::format("{}: the scene cannot be read: {}; check the name and the folder",
                      file.string(), error.description()));
    }
    throw InputError(
        fmt::format("{}:{}: {}", file.string(), error.source().begin.line, error.description()));
  }
  Scenario scenario;
  scenario.name = file.stem().string();
  scenario.family = "file";
  read_scene_options(read_options(document, scene_options(), {"material", "ball"}, file), scenario);
  if (const toml::node* material = document.get("material")) {
    if (!material->is_table()) {
      throw InputError(
          fmt::format("{}: write the material as a table: [material]", place(file, *material)));
    }
    scenario.material = material_from(
        read_options(*material->as_table(), material_options({}, "the target"), {}, file));
  }
  const toml::node* balls = document.get("ball");
  if (balls == nullptr) {
    throw InputError(
        fmt::format("{}: there is no ball; add one as [[ball]] with position and "
                    "velocity",
                    file.string()));
  }
  if (!balls->is_array_of_tables()) {
    throw InputError(fmt::format("{}: write each ball as a table: [[ball]]", place(file, *balls)));
  }
  for (const toml::node& ball : *balls->as_array()) {
    scenario.balls.push_back(read_ball(*ball.as_table(), file));
  }
  return scenario;
}

}  // namespace fracbench
