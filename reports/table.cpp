#include "reports/table.h"

#include <fmt/format.h>

#include <algorithm>

namespace fracbench {
namespace {

template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;  // which clang asks for

// Characters, not bytes: continuation bytes of UTF-8 take no room.
std::size_t width(std::string_view text) {
  return std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; });
}

std::string heading(const TableColumn& column, std::string_view part = "") {
  const std::string unit = column.unit.empty() ? "" : fmt::format(" [{}]", column.unit);
  return fmt::format("{}{}{}", column.name, part, unit);
}

// A pipe would end the cell, a line end the table.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c == '\n' || c == '\r' ? ' ' : c;
  }
  return result;
}

std::string for_reading(const TableCell& cell) {
  return std::visit(Overloaded{[](std::monostate) { return std::string(); },
                               [](const std::string& text) { return escaped(text); },
                               [](std::int64_t number) { return fmt::format("{}", number); },
                               [](double number) { return short_number(number); },
                               [](const Estimate& e) {
                                 return fmt::format("{} [{}, {}]", short_number(e.value),
                                                    short_number(e.low), short_number(e.high));
                               }},
                    cell);
}

std::string quoted(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

bool is_text(const TableCell& cell) { return std::holds_alternative<std::string>(cell); }
bool is_estimate(const TableCell& cell) { return std::holds_alternative<Estimate>(cell); }

template <typename Predicate>
std::vector<bool> columns_with_any(const Table& table, const Predicate& holds) {
  std::vector<bool> result(table.columns.size(), false);
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) result[c] = result[c] || holds(row[c]);
  }
  return result;
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) {
    if (&field != fields.data()) line += ',';
    line += quoted(field);
  }
  return line + "\r\n";
}

}  // namespace

TableCell number_or_nothing(std::optional<double> number) {
  TableCell cell;
  if (number) cell = *number;
  return cell;
}

std::string short_number(double value) { return fmt::format("{:.4g}", value); }

std::string to_markdown(const Table& table) {
  std::vector<std::vector<std::string>> lines(1);
  for (const TableColumn& column : table.columns) lines[0].push_back(escaped(heading(column)));
  for (const auto& row : table.rows) {
    auto& line = lines.emplace_back();
    for (const TableCell& cell : row) line.push_back(for_reading(cell));
  }
  std::vector<std::size_t> widths(table.columns.size(), 3);
  for (const auto& line : lines) {
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], width(line[c]));
  }
  const std::vector<bool> left = columns_with_any(table, is_text);
  std::string result;
  for (std::size_t r = 0; r < lines.size(); ++r) {
    for (std::size_t c = 0; c < lines[r].size(); ++c) {
      const std::string space(widths[c] - width(lines[r][c]), ' ');
      result += left[c] ? fmt::format("| {}{} ", lines[r][c], space)
                        : fmt::format("| {}{} ", space, lines[r][c]);
    }
    result += "|\n";
    if (r > 0) continue;
    for (std::size_t c = 0; c < widths.size(); ++c) {
      const std::string line(widths[c] - 1, '-');
      result += left[c] ? fmt::format("| :{} ", line) : fmt::format("| {}: ", line);
    }
    result += "|\n";
  }
  return result;
}

std::string to_csv(const Table& table) {
  const std::vector<bool> wide = columns_with_any(table, is_estimate);
  std::vector<std::string> header;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    header.push_back(heading(table.columns[c]));
    if (!wide[c]) continue;
    header.push_back(heading(table.columns[c], " low"));
    header.push_back(heading(table.columns[c], " high"));
  }
  return csv_line(header) + csv_rows(table);
}

std::string csv_rows(const Table& table) {
  const std::vector<bool> wide = columns_with_any(table, is_estimate);
  std::string result;
  for (const auto& row : table.rows) {
    std::vector<std::string> fields;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::size_t end = fields.size() + (wide[c] ? 3 : 1);
      std::visit(
          Overloaded{[&](std::monostate) {},
                     [&](const std::string& text) { fields.push_back(text); },
                     [&](std::int64_t number) { fields.push_back(fmt::format("{}", number)); },
                     [&](double number) { fields.push_back(fmt::format("{}", number)); },
                     [&](const Estimate& e) {
                       for (const double number : {e.value, e.low, e.high}) {
                         fields.push_back(fmt::format("{}", number));
                       }
                     }},
          row[c]);
      fields.resize(end);
    }
    result += csv_line(fields);
  }
  return result;
}

}  // namespace fracbench
