#include "reports/published.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/error.h"
#include "reports/csv.h"

namespace fracbench {
namespace {

// The lines of a file after its header, which must be as expected.
std::vector<std::vector<std::string>> read_lines(std::string_view name,
                                                 const std::vector<std::string>& header) {
  const std::filesystem::path file = std::filesystem::path(FRACBENCH_PUBLISHED_FOLDER) / name;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw InputError(
        fmt::format("{}: published values are missing; they belong to the program", file.string()));
  }
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  auto lines = parse_csv(text, file.string());
  if (lines.empty() || lines.front() != header) {
    throw InputError(
        fmt::format("{}: expected the header {}", file.string(), fmt::join(header, ",")));
  }
  lines.erase(lines.begin());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].size() == header.size()) continue;
    throw InputError(fmt::format("{}:{}: {} fields instead of {}", file.string(), i + 2,
                                 lines[i].size(), header.size()));
  }
  return lines;
}

double parse_seconds(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw InputError(fmt::format("published values: '{}' is not a number of seconds", text));
  }
  return value;
}

}  // namespace

std::vector<PublishedTime> published_times() {
  std::vector<PublishedTime> times;
  for (const auto& line :
       read_lines("table-2.csv", {"table", "row", "column", "shape", "method", "resolution",
                                  "stage", "printed", "seconds"})) {
    times.push_back({.table = line[0],
                     .row = line[1],
                     .column = line[2],
                     .shape = line[3],
                     .method = line[4],
                     .resolution = line[5],
                     .stage = line[6],
                     .printed = line[7],
                     .seconds = parse_seconds(line[8])});
  }
  return times;
}

std::vector<Erratum> published_errata() {
  std::vector<Erratum> errata;
  for (const auto& line : read_lines("errata.csv", {"name", "place", "finding", "consequence"})) {
    errata.push_back(
        {.name = line[0], .place = line[1], .finding = line[2], .consequence = line[3]});
  }
  return errata;
}

}  // namespace fracbench
