#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace fracbench {

using OptionValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

/// One option of a method, scenario or shape. The type is that of the default.
struct OptionSpec {
  std::string name;
  OptionValue fallback;  ///< the value where none is given
  std::string unit;      ///< "m", "N s", ...; empty: a pure number
  std::string summary;   ///< one line, for --help
  std::optional<double> minimum = {};
  std::optional<double> maximum = {};
  std::vector<std::string> choices = {};  ///< for text: the only values allowed
};

using OptionsSchema = std::vector<OptionSpec>;
using OptionMap = std::map<std::string, OptionValue, std::less<>>;

/// Values for a whole schema: complete and within their ranges. The getters throw std::logic_error
/// for a name or type that the schema does not have, since that is a mistake in the program.
class Options {
 public:
  Options() = default;

  /// Checks `given` against `schema` and fills the rest with defaults. Throws InputError for an
  /// unknown name (naming the nearest), a wrong type or a value out of range (naming the unit);
  /// `where` says whose options these are.
  Options(const OptionsSchema& schema, const OptionMap& given, std::string_view where);

  bool flag(std::string_view name) const;
  std::int64_t integer(std::string_view name) const;
  double number(std::string_view name) const;
  const std::string& text(std::string_view name) const;
  const std::vector<double>& numbers(std::string_view name) const;

  const OptionMap& values() const { return values_; }
  nlohmann::ordered_json to_json() const;

 private:
  OptionMap values_;
};

/// Reads the value of an option from text, as in --set name=value. Throws InputError.
OptionValue parse_option(const OptionsSchema& schema, std::string_view name, std::string_view text,
                         std::string_view where);

/// Name, type, default, unit, range, choices and summary of every option.
nlohmann::ordered_json to_json(const OptionsSchema& schema);

}  // namespace fracbench
