#include "reports/page/write_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/parallel.h"
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

/// Makes the files that a page shows of single cells, each from one look at the cell's record.
class CellFiles {
 public:
  CellFiles(const ReportInput& input, const fs::path& results, const fs::path& folder, bool viewer,
            const PageFilesOptions& options)
      : cells_(input.cells), results_(results), viewer_(viewer), options_(options) {
    if (viewer) make_folder(cell_folder_ = folder / "cells");
    const fs::path pictures = folder / "pictures";
    make_folder(pictures);
    for (const SheetRow& row : sheet_rows(cells_)) {
      for (const auto& [method, cell] : row.cells) {
        pictures_[cell] = pictures / (picture_name(row, method) + ".png");
      }
    }
  }

  /// Returns the keys of the cells that the viewer can show, sorted.
  std::vector<std::string> write() {
    std::vector<char> viewed(cells_.size(), 0);
    parallel_for(cells_.size(), options_.threads, [&](std::size_t i) {
      if (options_.stop.stop_requested()) throw Cancelled();
      viewed[i] = write(cells_[i]);
      note_done();
    });
    files_.commit();
    for (const CellSummary& cell : cells_) {
      const auto found = complaints_.find(&cell);
      if (found != complaints_.end() && options_.message) options_.message(found->second);
    }
    std::vector<std::string> keys;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (viewed[i]) keys.push_back(cells_[i].key);
    }
    std::ranges::sort(keys);
    return keys;
  }

 private:
  /// Whether the viewer can show it. What is wrong with its data is told, and that is all.
  bool write(const CellSummary& cell) {
    const fs::path view = cell_folder_ / fmt::format("{}.js", cell.key);
    const fs::path mesh = cell_folder_ / fmt::format("{}.glb", cell.key);
    const bool shown =
        viewer_ && (cell.status == CellStatus::ok || cell.status == CellStatus::invalid ||
                    cell.status == CellStatus::unbroken);
    const bool needs_view = shown && !begins_with(view, cell_view_head(cell.key));
    const bool needs_mesh = shown && options_.meshes && !fs::exists(mesh);
    const auto picture = pictures_.find(&cell);
    if (!needs_view && !needs_mesh && picture == pictures_.end()) return shown;
    try {
      const Record record = read_record(results_, cell.key);
      const TriangleMesh& target = target_of(record);
      if (needs_view) files_.add(view, cell_view(record, target, options_.view));
      if (needs_mesh) {
        const SceneResult& scene = record.outcome.scene;
        write_motion(mesh, target, scene.fragments, scene.trajectory, ball_radii(record));
      }
      if (picture != pictures_.end()) write_picture(picture->second, record, target);
    } catch (const DataError& error) {
      const std::scoped_lock lock(mutex_);
      complaints_[&cell] = fmt::format("{} {} {}: cannot be shown: {}", cell.shape, cell.scenario,
                                       cell.label, error.what());
      return shown && !needs_view && !needs_mesh;
    }
    return shown;
  }

  const TriangleMesh& target_of(const Record& record) {
    const std::scoped_lock lock(mutex_);
    TriangleMesh& mesh = targets_[record.identity.shape_digest];
    if (mesh.empty()) mesh = read_target(results_, record.identity.shape_digest);
    return mesh;
  }

  /// Twice as fine as it is shown.
  void write_picture(const fs::path& file, const Record& record, const TriangleMesh& target) {
    const RecordPictureOptions options{.width = 2 * kThumbnail, .height = 2 * kThumbnail};
    const Picture picture = [&] {
      const std::scoped_lock one_at_a_time(renderer_);
      return picture_of(record, target, options);
    }();
    files_.add(file, png_bytes(picture));
  }

  void note_done() {
    const std::scoped_lock lock(mutex_);
    ++done_;
    if (!options_.progress) return;
    options_.progress->update("cells for the page",
                              static_cast<double>(done_) / static_cast<double>(cells_.size()));
  }

  const std::vector<CellSummary>& cells_;
  const fs::path& results_;
  const bool viewer_;
  const PageFilesOptions& options_;
  fs::path cell_folder_;
  std::map<const CellSummary*, fs::path> pictures_;  ///< one of each method and shape
  AtomicFiles files_;
  std::mutex renderer_;
  std::mutex mutex_;  // guards all that follows
  std::map<std::string, TriangleMesh> targets_;
  std::map<const CellSummary*, std::string> complaints_;
  std::size_t done_ = 0;
};

}  // namespace

bool has_viewer() { return !asset("page.js").empty(); }

fs::path write_page(const ReportInput& all, const std::vector<NamedSection>& sections,
                    const fs::path& results, const fs::path& folder,
                    const PageFilesOptions& options) {
  make_folder(folder);
  const std::string script = asset("page.js");
  const ReportInput input{.title = all.title,
                          .cells = shown_cells(all.cells, options.cells),
                          .study = all.study,
                          .agreements = all.agreements,
                          .provenance = all.provenance,
                          .suite = all.suite,
                          .bootstrap = all.bootstrap,
                          .seed = all.seed};
  PageOptions page{.script = !script.empty(), .viewed = {}, .commands = options.commands};
  page.viewed = CellFiles(input, results, folder, page.script, options).write();
  if (page.script) write_file_atomically(folder / "page.js", script);
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
