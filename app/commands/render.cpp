#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <ranges>

#include "app/command.h"
#include "app/command_progress.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "harness/record_store.h"
#include "harness/summaries.h"
#include "reports/picture/record_picture.h"
#include "reports/picture/sheet.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

struct RenderArguments {
  fs::path results;
  fs::path out;
  SheetOptions sheet;
  bool motion = false;
  RecordPictureOptions picture;
};

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
  const std::vector<SheetRow> rows = sheet_rows(results.cells, a.sheet);
  if (rows.empty()) {
    fmt::print(stderr, "fracbench: {}: there is no record to draw\n", a.results.string());
    return ExitCode::not_measured;
  }
  const std::vector<std::string> columns = sheet_columns(results.cells, rows);
  fs::create_directories(a.out);
  CommandProgress progress;
  bool all_drawn = true;
  const int size = a.picture.width;
  Picture sheet(size * static_cast<int>(columns.size()), size * static_cast<int>(rows.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto cell = rows[r].cells.find(columns[c]);
      if (cell == rows[r].cells.end()) continue;
      if (stop.stop_requested()) throw Cancelled();
      Record record;
      TriangleMesh target;
      try {
        record = read_record(a.results, cell->second->key);
        target = read_target(a.results, record.identity.shape_digest);
      } catch (const DataError& error) {
        fmt::print(stderr, "fracbench: left out: {}\n", error.what());
        all_drawn = false;
        continue;
      }
      const Picture picture = picture_of(record, target, a.picture);
      const std::string name = picture_name(rows[r], columns[c]);
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
             fmt::join(rows | std::views::transform(&SheetRow::name), ", "),
             fmt::join(columns, ", "), (a.out / "sheet.png").string());
  return all_drawn ? ExitCode::good : ExitCode::not_measured;
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
  command->add_option("--shapes", a->sheet.shapes, "Only these shapes (comma-separated)")
      ->delimiter(',');
  command->add_option("--methods", a->sheet.methods, "Only these methods (comma-separated)")
      ->delimiter(',');
  command->add_option("--collisions", a->sheet.collisions, "Of each shape")
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
