#include "scenarios/families/published.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"
#include "scenarios/families/common_options.h"

namespace fracbench {

namespace {

const std::vector<std::string> kColumns = {"shape", "id", "px", "py", "pz", "vx", "vy", "vz"};

struct Condition {
  std::string shape;
  std::string id;
  Vec3 position;
  Vec3 velocity;
};

std::vector<std::string> split(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  std::vector<std::string> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (!cell.empty() && cell.front() == ' ') cell.remove_prefix(1);
    while (!cell.empty() && cell.back() == ' ') cell.remove_suffix(1);
    cells.emplace_back(cell);
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

std::string_view prefix(std::string_view shape) {
  return shape.substr(0, shape.find_first_of("_-"));
}

double number(const std::string& text, std::string_view column, const std::string& place) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw InputError(fmt::format("{}: {} is '{}', must be a finite number", place, column, text));
  }
  return value;
}

std::vector<Condition> read_conditions(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) {
    throw InputError(fmt::format("{}: cannot be read; it must be a CSV file with the columns {}",
                                 path.string(), fmt::join(kColumns, ",")));
  }
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> header = split(line);
  std::array<std::size_t, 8> at{};
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    const auto found = std::ranges::find(header, kColumns[c]);
    if (found == header.end()) {
      throw InputError(fmt::format("{}:1: there is no column '{}'; the columns must be {}",
                                   path.string(), kColumns[c], fmt::join(kColumns, ",")));
    }
    at[c] = static_cast<std::size_t>(found - header.begin());
  }
  std::vector<Condition> conditions;
  for (int row = 2; std::getline(file, line); ++row) {
    const std::string place = fmt::format("{}:{}", path.string(), row);
    const std::vector<std::string> cells = split(line);
    if (cells.size() == 1 && cells[0].empty()) continue;
    if (cells.size() != header.size()) {
      throw InputError(
          fmt::format("{}: {} values, the header has {}", place, cells.size(), header.size()));
    }
    const auto vector = [&](std::size_t first) {
      Vec3 v;
      for (int k = 0; k < 3; ++k) {
        v[k] = number(cells[at[first + k]], kColumns[first + k], place);
      }
      return v;
    };
    conditions.push_back(
        {.shape = cells[at[0]], .id = cells[at[1]], .position = vector(2), .velocity = vector(5)});
    if (!(conditions.back().velocity.norm() > 0)) {
      throw InputError(fmt::format("{}: the velocity is 0, the ball would never move", place));
    }
  }
  return conditions;
}

}  // namespace

FamilyInfo PublishedFamily::info() const {
  return {.name = "published", .summary = "collision conditions of one ball, read from a CSV file"};
}

OptionsSchema PublishedFamily::options() const {
  return joined({{.name = "file",
                  .fallback = std::string(),
                  .unit = "",
                  .summary = "CSV file with the columns shape,id,px,py,pz,vx,vy,vz (m, m/s)"},
                 {.name = "count",
                  .fallback = std::int64_t{0},
                  .unit = "",
                  .summary = "number of scenes; 0: all there are for the shape",
                  .minimum = 0,
                  .maximum = 1e6}},
                common_options());
}

std::vector<Scenario> PublishedFamily::scenes(const Options& options, std::string_view shape,
                                              std::uint64_t) const {
  const std::string& file = options.text("file");
  if (file.empty()) {
    throw InputError(
        "scenario family 'published': option 'file' is not given; name a CSV file with the columns "
        "shape,id,px,py,pz,vx,vy,vz");
  }
  const auto limit = static_cast<std::size_t>(options.integer("count"));
  std::vector<Scenario> scenes;
  std::vector<std::string> known;
  for (const Condition& condition : read_conditions(file)) {
    if (std::ranges::find(known, condition.shape) == known.end()) known.push_back(condition.shape);
    if (prefix(condition.shape) != prefix(shape)) continue;
    if (limit > 0 && scenes.size() == limit) continue;
    Scenario scene =
        common_scenario(options, "published", fmt::format("{}-{}", condition.shape, condition.id));
    if (std::ranges::find(scenes, scene.name, &Scenario::name) != scenes.end()) {
      throw InputError(
          fmt::format("{}: shape '{}' has the id '{}' twice", file, condition.shape, condition.id));
    }
    scene.balls = {common_ball(options, condition.position, condition.velocity)};
    scenes.push_back(std::move(scene));
  }
  if (scenes.empty()) {
    throw InputError(
        fmt::format("{}: there are no collision conditions for the shape '{}'; there "
                    "are some for {}",
                    file, shape, fmt::join(known, ", ")));
  }
  return scenes;
}

}  // namespace fracbench
