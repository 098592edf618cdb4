#include "reports/csv.h"

#include <fmt/format.h>

#include "core/error.h"

namespace fracbench {

std::vector<std::vector<std::string>> parse_csv(std::string_view text, std::string_view where) {
  std::vector<std::vector<std::string>> lines;
  bool in_line = false;
  bool in_quotes = false;
  const auto field = [&]() -> std::string& {
    if (!in_line) lines.push_back({""});
    in_line = true;
    return lines.back().back();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_quotes) {
      const bool doubled = c == '"' && i + 1 < text.size() && text[i + 1] == '"';
      if (c == '"' && !doubled) {
        in_quotes = false;
      } else {
        field() += c;
        i += doubled ? 1 : 0;
      }
    } else if (c == '"') {
      field();
      in_quotes = true;
    } else if (c == ',') {
      field();
      lines.back().emplace_back();
    } else if (c == '\n') {
      field();
      in_line = false;
    } else if (c != '\r') {
      field() += c;
    }
  }
  if (in_quotes) throw InputError(fmt::format("{}: a quote is not closed", where));
  return lines;
}

}  // namespace fracbench
