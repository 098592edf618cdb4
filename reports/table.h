#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fracbench {

/// An estimate with its confidence interval.
struct Estimate {
  double value = 0;
  double low = 0;
  double high = 0;

  bool operator==(const Estimate&) const = default;
};

/// What stands in one place of a table; monostate: nothing.
using TableCell = std::variant<std::monostate, std::string, std::int64_t, double, Estimate>;

struct TableColumn {
  std::string name;
  std::string unit = {};  ///< empty: a pure number or text
};

/// The number, or nothing.
TableCell number_or_nothing(std::optional<double> number);

/// A table value, which knows nothing of where it is shown.
struct Table {
  std::string name;   ///< of its CSV file
  std::string title;  ///< of its section
  std::vector<std::string> notes = {};
  std::vector<TableColumn> columns = {};
  std::vector<std::vector<TableCell>> rows = {};  ///< each as long as columns
  bool in_text = true;                            ///< false: too long to read, given as CSV only
};

/// An aligned pipe table with numbers of four significant digits, numbers to the right; estimates
/// as "3.2 [2.9, 3.6]". Title and notes are not part of it.
std::string to_markdown(const Table& table);

/// RFC 4180, with a header "name [unit]", CRLF line ends, and numbers that read back to the same
/// bits. A column with estimates becomes three: name, "name low" and "name high".
std::string to_csv(const Table& table);

/// The same without the header: a table that is too long to hold comes in parts.
std::string csv_rows(const Table& table);

/// Four significant digits, without trailing zeros; what is shorter in powers of ten is so.
std::string short_number(double value);

}  // namespace fracbench
