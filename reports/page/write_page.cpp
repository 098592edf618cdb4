#include "reports/page/write_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "core/atomic_file.h"
#include "core/error.h"
#include "geometry/write_motion.h"
#include "harness/record_store.h"
#include "reports/page/html_page.h"
#include "reports/page/shown_cells.h"
#include "reports/picture/record_picture.h"
#include "reports/picture/sheet.h"
#include "reports/scene_parts.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

/// The style and the script as they were built; empty for a script that was not.
std::string asset(const char* name) {
  std::ifstream stream(fs::path(FRACBENCH_PAGE_FOLDER) / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool begins_with(const fs::path& file, const std::string& head) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(head.size(), '\0');
  return stream.read(start.data(), static_cast<std::streamsize>(start.size())) && start == head;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(fmt::format("{}: the folder for the report cannot be made: {}",
                                 folder.string(), error.message()));
  }
}

/// A record with its target, read for one use after the other.
class Reader {
 public:
  explicit Reader(const fs::path& results) : results_(results) {}

  Record record(const std::string& key) const { return read_record(results_, key); }
  const TriangleMesh& target(const Record& record) {
    TriangleMesh& mesh = targets_[record.identity.shape_digest];
    if (mesh.empty()) mesh = read_target(results_, record.identity.shape_digest);
    return mesh;
  }

 private:
  const fs::path& results_;
  std::map<std::string, TriangleMesh> targets_;
};

/// Does something for a cell; what is wrong with its data is told, and that is all.
bool attempt(const CellSummary& cell, const PageFilesOptions& options,
             const std::function<void()>& work) {
  if (options.stop.stop_requested()) throw Cancelled();
  try {
    work();
    return true;
  } catch (const DataError& error) {
    if (options.message) {
      options.message(fmt::format("{} {} {}: cannot be shown: {}", cell.shape, cell.scenario,
                                  cell.label, error.what()));
    }
    return false;
  }
}

/// Writes the files of all cells; returns the keys of those that there is one for, sorted.
std::vector<std::string> write_cells(const ReportInput& input, Reader& reader,
                                     const fs::path& folder, const PageFilesOptions& options) {
  make_folder(folder);
  std::vector<std::string> keys;
  for (const CellSummary& cell : input.cells) {
    const fs::path file = folder / fmt::format("{}.js", cell.key);
    const bool broken = cell.status == CellStatus::ok || cell.status == CellStatus::invalid;
    if (!broken && cell.status != CellStatus::unbroken) continue;
    const fs::path mesh = folder / fmt::format("{}.glb", cell.key);
    const bool has_view = begins_with(file, cell_view_head(cell.key));
    const bool has_mesh = !options.meshes || fs::exists(mesh);
    const bool there =
        (has_view && has_mesh) || attempt(cell, options, [&] {
          const Record record = reader.record(cell.key);
          const TriangleMesh& target = reader.target(record);
          if (!has_view) {
            write_file_atomically(file, cell_view(record, target, options.view));
          }
          if (!has_mesh) {
            const SceneResult& scene = record.outcome.scene;
            write_motion(mesh, target, scene.fragments, scene.trajectory, ball_radii(record));
          }
        });
    if (there) keys.push_back(cell.key);
    if (options.progress) {
      const auto done = static_cast<double>(&cell - input.cells.data() + 1);
      options.progress->update("cells for the viewer",
                               done / static_cast<double>(input.cells.size()));
    }
  }
  std::ranges::sort(keys);
  return keys;
}

/// One picture of each method and shape, twice as fine as it is shown.
void write_pictures(const ReportInput& input, Reader& reader, const fs::path& folder,
                    const PageFilesOptions& options) {
  make_folder(folder);
  for (const SheetRow& row : sheet_rows(input.cells)) {
    for (const auto& [method, cell] : row.cells) {
      attempt(*cell, options, [&] {
        const Record record = reader.record(cell->key);
        const Picture picture = picture_of(record, reader.target(record),
                                           {.width = 2 * kThumbnail, .height = 2 * kThumbnail});
        write_file_atomically(folder / (picture_name(row, method) + ".png"), png_bytes(picture));
      });
    }
  }
}

}  // namespace

bool has_viewer() { return !asset("page.js").empty(); }

fs::path write_page(const ReportInput& all, const std::vector<NamedSection>& sections,
                    const fs::path& results, const fs::path& folder,
                    const PageFilesOptions& options) {
  make_folder(folder);
  const std::string script = asset("page.js");
  Reader reader(results);
  const ReportInput input{.title = all.title,
                          .cells = shown_cells(all.cells, options.cells),
                          .agreements = all.agreements,
                          .provenance = all.provenance,
                          .suite = all.suite,
                          .bootstrap = all.bootstrap,
                          .seed = all.seed};
  PageOptions page{.script = !script.empty(), .viewed = {}, .commands = options.commands};
  if (page.script) {
    page.viewed = write_cells(input, reader, folder / "cells", options);
    write_file_atomically(folder / "page.js", script);
  }
  write_pictures(input, reader, folder / "pictures", options);
  page.pictures = true;
  page.meshes = options.meshes;
  page.cells = all.cells.size();
  write_file_atomically(folder / "page.css", asset("page.css"));
  std::ifstream suite(results / "suite.json", std::ios::binary);
  write_file_atomically(folder / "suite.json",
                        std::string(std::istreambuf_iterator<char>(suite), {}));
  const fs::path index = folder / "index.html";
  write_file_atomically(index, html_page(input, sections, page));
  return index;
}

}  // namespace fracbench
