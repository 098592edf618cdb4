#include "core/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/error.h"
#include "core/text.h"

namespace fracbench {

namespace {

constexpr const char* kTypeNames[] = {"true or false", "a whole number", "a number", "text",
                                      "a list of numbers"};
constexpr const char* kJsonTypeNames[] = {"boolean", "integer", "number", "string", "numbers"};

const OptionSpec& find_spec(const OptionsSchema& schema, std::string_view name,
                            std::string_view where) {
  const auto found = std::ranges::find(schema, name, &OptionSpec::name);
  if (found != schema.end()) return *found;
  std::vector<std::string> names;
  for (const OptionSpec& spec : schema) names.push_back(spec.name);
  throw InputError(
      fmt::format("{}: unknown option '{}'{}", where, name, did_you_mean(name, names)));
}

std::string with_unit(double value, const OptionSpec& spec) {
  return spec.unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, spec.unit);
}

void check_range(double value, const OptionSpec& spec, std::string_view where) {
  const bool low = spec.minimum && value < *spec.minimum;
  const bool high = spec.maximum && value > *spec.maximum;
  if (std::isfinite(value) && !low && !high) return;
  std::string allowed = "a finite number";
  if (spec.minimum && spec.maximum) {
    allowed = fmt::format("{} to {}", *spec.minimum, with_unit(*spec.maximum, spec));
  } else if (spec.minimum) {
    allowed = fmt::format("at least {}", with_unit(*spec.minimum, spec));
  } else if (spec.maximum) {
    allowed = fmt::format("at most {}", with_unit(*spec.maximum, spec));
  }
  throw InputError(fmt::format("{}: option '{}' is {}, allowed is {}", where, spec.name,
                               with_unit(value, spec), allowed));
}

OptionValue checked(OptionValue value, const OptionSpec& spec, std::string_view where) {
  // Whole numbers are numbers too.
  if (std::holds_alternative<double>(spec.fallback) &&
      std::holds_alternative<std::int64_t>(value)) {
    value = static_cast<double>(std::get<std::int64_t>(value));
  }
  if (value.index() != spec.fallback.index()) {
    throw InputError(fmt::format("{}: option '{}' must be {}", where, spec.name,
                                 kTypeNames[spec.fallback.index()]));
  }
  if (const auto* number = std::get_if<double>(&value)) check_range(*number, spec, where);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    check_range(static_cast<double>(*whole), spec, where);
  }
  if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    for (const double number : *list) check_range(number, spec, where);
  }
  if (const auto* text = std::get_if<std::string>(&value);
      text && !spec.choices.empty() &&
      std::ranges::find(spec.choices, *text) == spec.choices.end()) {
    throw InputError(fmt::format("{}: option '{}' is '{}'; known: {}", where, spec.name, *text,
                                 fmt::join(spec.choices, ", ")));
  }
  return value;
}

template <typename T>
const T& get(const OptionMap& values, std::string_view name) {
  const auto found = values.find(name);
  if (found == values.end() || !std::holds_alternative<T>(found->second)) {
    throw std::logic_error(fmt::format("no option '{}' of this type in the schema", name));
  }
  return std::get<T>(found->second);
}

template <typename T>
T parse_number(std::string_view text, const OptionSpec& spec, std::string_view where) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw InputError(fmt::format("{}: option '{}' is '{}', must be {}", where, spec.name, text,
                                 kTypeNames[spec.fallback.index()]));
  }
  return value;
}

}  // namespace

Options::Options(const OptionsSchema& schema, const OptionMap& given, std::string_view where) {
  for (const OptionSpec& spec : schema) values_[spec.name] = spec.fallback;
  for (const auto& [name, value] : given) {
    values_[name] = checked(value, find_spec(schema, name, where), where);
  }
}

bool Options::flag(std::string_view name) const { return get<bool>(values_, name); }

std::int64_t Options::integer(std::string_view name) const {
  return get<std::int64_t>(values_, name);
}

double Options::number(std::string_view name) const { return get<double>(values_, name); }

const std::string& Options::text(std::string_view name) const {
  return get<std::string>(values_, name);
}

const std::vector<double>& Options::numbers(std::string_view name) const {
  return get<std::vector<double>>(values_, name);
}

nlohmann::ordered_json Options::to_json() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, value] : values_) {
    std::visit([&](const auto& v) { json[name] = v; }, value);
  }
  return json;
}

OptionValue parse_option(const OptionsSchema& schema, std::string_view name, std::string_view text,
                         std::string_view where) {
  const OptionSpec& spec = find_spec(schema, name, where);
  OptionValue value;
  if (std::holds_alternative<bool>(spec.fallback)) {
    if (text != "true" && text != "false") {
      throw InputError(
          fmt::format("{}: option '{}' is '{}', must be true or false", where, name, text));
    }
    value = text == "true";
  } else if (std::holds_alternative<std::int64_t>(spec.fallback)) {
    value = parse_number<std::int64_t>(text, spec, where);
  } else if (std::holds_alternative<double>(spec.fallback)) {
    value = parse_number<double>(text, spec, where);
  } else if (std::holds_alternative<std::string>(spec.fallback)) {
    value = std::string(text);
  } else {
    std::vector<double> list;
    while (!text.empty()) {
      const std::size_t comma = std::min(text.find(','), text.size());
      list.push_back(parse_number<double>(text.substr(0, comma), spec, where));
      text.remove_prefix(std::min(comma + 1, text.size()));
    }
    value = std::move(list);
  }
  return checked(std::move(value), spec, where);
}

nlohmann::ordered_json to_json(const OptionsSchema& schema) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const OptionSpec& spec : schema) {
    nlohmann::ordered_json item;
    item["name"] = spec.name;
    item["type"] = kJsonTypeNames[spec.fallback.index()];
    std::visit([&](const auto& v) { item["default"] = v; }, spec.fallback);
    if (!spec.unit.empty()) item["unit"] = spec.unit;
    if (spec.minimum) item["minimum"] = *spec.minimum;
    if (spec.maximum) item["maximum"] = *spec.maximum;
    if (!spec.choices.empty()) item["choices"] = spec.choices;
    item["summary"] = spec.summary;
    list.push_back(item);
  }
  return list;
}

}  // namespace fracbench
