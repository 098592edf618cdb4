#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <ranges>

#include "app/command.h"
#include "app/command_progress.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "harness/record_store.h"
#include "harness/summaries.h"
#include "reports/figure.h"
#include "reports/picture/record_picture.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

struct RenderArguments {
  fs::path results;
  fs::path out;
  std::vector<std::string> shapes;
  std::vector<std::string> methods;
  int collisions = 1;
  bool motion = false;
  RecordPictureOptions picture;
};

/// A row of the sheet: one impact on one shape, by method.
struct Row {
  std::string name;
  std::map<std::string, const CellSummary*> cells;  // by label
};

bool wanted(const std::vector<std::string>& list, const std::string& name) {
  return list.empty() || std::ranges::find(list, name) != list.end();
}

/// For each shape the first collisions that most methods broke it in.
std::vector<Row> rows_of(const Results& results, const RenderArguments& a) {
  std::vector<Row> rows;
  std::map<std::string, std::vector<Row>> by_shape;
  std::vector<std::string> shapes;
  for (const CellSummary& cell : results.cells) {
    const bool seen = cell.status == CellStatus::ok || cell.status == CellStatus::unbroken;
    if (!seen || cell.repeat > 0 || !wanted(a.shapes, cell.shape) ||
        !wanted(a.methods, cell.label)) {
      continue;
    }
    if (!by_shape.contains(cell.shape)) shapes.push_back(cell.shape);
    std::vector<Row>& list = by_shape[cell.shape];
    const std::string name = cell.shape + "-" + cell.scenario;
    if (list.empty() || list.back().name != name) list.push_back({name, {}});
    list.back().cells[cell.label] = &cell;
  }
  for (const std::string& shape : shapes) {
    std::vector<Row>& list = by_shape[shape];
    const auto broken = [](const Row& row) {
      return std::ranges::count_if(
          row.cells, [](const auto& c) { return c.second->status == CellStatus::ok; });
    };
    std::ranges::stable_sort(list,
                             [&](const Row& x, const Row& y) { return broken(x) > broken(y); });
    const auto count = std::min(list.size(), static_cast<std::size_t>(a.collisions));
    rows.insert(rows.end(), list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return rows;
}

std::vector<std::string> columns_of(const Results& results, const std::vector<Row>& rows) {
  std::vector<std::string> columns;
  for (const CellSummary& cell : results.cells) {
    const bool there =
        std::ranges::any_of(rows, [&](const Row& row) { return row.cells.contains(cell.label); });
    if (there && std::ranges::find(columns, cell.label) == columns.end()) {
      columns.push_back(cell.label);
    }
  }
  return columns;
}

/// Frames of the motion as numbered files in a folder of their own, for a video.
void write_motion_pictures(const Record& record, const TriangleMesh& target, const fs::path& folder,
                           RecordPictureOptions options, const std::stop_token& stop,
                           Progress& progress) {
  fs::create_directories(folder);
  options.apart = 0;
  const int frames = frames_of(record);
  for (int frame = 0; frame < frames; ++frame) {
    if (stop.stop_requested()) throw Cancelled();
    const fs::path file = folder / fmt::format("{:04}.png", frame);
    if (fs::exists(file)) continue;
    options.frame = frame;
    write_file_atomically(file, png_bytes(picture_of(record, target, options)));
    progress.update(folder.filename().string(), static_cast<double>(frame + 1) / frames);
  }
}

ExitCode render(RenderArguments a, const std::stop_token& stop) {
  if (a.out.empty()) a.out = a.results / "report" / "pictures";
  a.picture.height = a.picture.width;
  const Results results = read_results(a.results);
  const std::vector<Row> rows = rows_of(results, a);
  if (rows.empty()) {
    fmt::print(stderr, "fracbench: {}: there is no record to draw\n", a.results.string());
    return ExitCode::not_measured;
  }
  const std::vector<std::string> columns = columns_of(results, rows);
  fs::create_directories(a.out);
  CommandProgress progress;
  const int size = a.picture.width;
  Picture sheet(size * static_cast<int>(columns.size()), size * static_cast<int>(rows.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto cell = rows[r].cells.find(columns[c]);
      if (cell == rows[r].cells.end()) continue;
      if (stop.stop_requested()) throw Cancelled();
      const Record record = read_record(a.results, cell->second->key);
      const TriangleMesh target = read_target(a.results, record.identity.shape_digest);
      const Picture picture = picture_of(record, target, a.picture);
      const std::string name = file_name_part(fmt::format("{}-{}", rows[r].name, columns[c]));
      write_file_atomically(a.out / (name + ".png"), png_bytes(picture));
      paste(picture, size * static_cast<int>(c), size * static_cast<int>(r), sheet);
      if (a.motion) {
        write_motion_pictures(record, target, a.out / name, a.picture, stop, progress);
      }
      progress.update("pictures", static_cast<double>(r * columns.size() + c + 1) /
                                      static_cast<double>(rows.size() * columns.size()));
    }
  }
  write_file_atomically(a.out / "sheet.png", png_bytes(sheet));
  fmt::print("rows:    {}\ncolumns: {}\n{}\n",
             fmt::join(rows | std::views::transform(&Row::name), ", "), fmt::join(columns, ", "),
             (a.out / "sheet.png").string());
  return ExitCode::good;
}

}  // namespace

void add_render_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
      "render",
      "Pictures of the fragments in a results folder, as PNG: rows are collisions, columns "
      "methods");
  auto a = std::make_shared<RenderArguments>();
  command->add_option("results", a->results, "Results folder of 'fracbench run'")->required();
  command->add_option("--out", a->out, "Folder of the pictures [<results>/report/pictures]");
  command->add_option("--shapes", a->shapes, "Only these shapes (comma-separated)")->delimiter(',');
  command->add_option("--methods", a->methods, "Only these methods (comma-separated)")
      ->delimiter(',');
  command->add_option("--collisions", a->collisions, "Of each shape")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--size", a->picture.width, "Of a picture, pixels")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  command->add_option("--apart", a->picture.apart, "How far fragments are pulled apart")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_flag("--surface", a->picture.by_surface,
                    "Colours by original and fracture surface, not by fragment");
  command->add_flag("--wireframe", a->picture.wireframe, "With the edges of the faces");
  command->add_flag("--motion", a->motion,
                    "Also every frame of the recorded motion, in a folder for each picture");
  command->callback(
      [&chosen, a] { chosen = [a](const std::stop_token& stop) { return render(*a, stop); }; });
}

}  // namespace fracbench
