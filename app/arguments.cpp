#include "app/arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/error.h"

namespace fracbench {

std::vector<double> parse_numbers(std::string_view text, std::size_t count,
                                  std::string_view argument, std::string_view form) {
  std::vector<double> numbers;
  std::string_view rest = text;
  while (numbers.size() < count) {
    const std::string_view item = rest.substr(0, rest.find(','));
    double value = 0;
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
    if (error != std::errc() || end != item.data() + item.size() || !std::isfinite(value)) {
      throw InputError(
          fmt::format("{} {}: '{}' is not a number; the form is {}", argument, text, item, form));
    }
    numbers.push_back(value);
    if (item.size() == rest.size()) {
      rest = {};
      break;
    }
    rest.remove_prefix(item.size() + 1);
    if (numbers.size() == count) {
      throw InputError(
          fmt::format("{} {}: more than {} numbers; the form is {}", argument, text, count, form));
    }
  }
  if (numbers.size() != count) {
    throw InputError(fmt::format("{} {}: {} numbers, must be {}; the form is {}", argument, text,
                                 numbers.size(), count, form));
  }
  return numbers;
}

Options parse_settings(const OptionsSchema& schema, const std::vector<std::string>& settings,
                       std::string_view where) {
  OptionMap given;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw InputError(fmt::format("--set {}: the form is name=value", setting));
    }
    const std::string name = setting.substr(0, equals);
    given[name] = parse_option(schema, name, setting.substr(equals + 1), where);
  }
  return Options(schema, given, where);
}

}  // namespace fracbench
