#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"
#include "reports/page/cell_view.h"
#include "reports/sections.h"

namespace fracbench {

struct PageFilesOptions {
  std::vector<std::string> commands = {};  ///< that make the results and this report
  CellViewOptions view = {};
  std::size_t cells = 1000;          ///< how many are shown one by one at most, see shown_cells
  bool meshes = false;               ///< also whole meshes with their motion, cells/<key>.glb
  int threads = hardware_threads();  ///< the same files for any number of them
  std::stop_token stop = {};
  Progress* progress = nullptr;
  /// Told of each cell that cannot be shown, and why: the rest of the page is made all the same.
  std::function<void(std::string_view)> message = {};
};

/// Whether the program was built with the viewer; else pages have none.
bool has_viewer();

/// Writes a page that opens from a disk without a network below `folder`, beside the tables and
/// figures of write_report: index.html, page.css, page.js, suite.json and, for the viewer, a file
/// cells/<key>.js for each cell that is shown, from the records of the results folder. Files of
/// cells that are there already are kept: their names stand for what is in them. index.html comes
/// last; returns its path. Throws InputError where it cannot be written, Cancelled when it was
/// asked to stop.
std::filesystem::path write_page(const ReportInput& input,
                                 const std::vector<NamedSection>& sections,
                                 const std::filesystem::path& results,
                                 const std::filesystem::path& folder,
                                 const PageFilesOptions& options = {});

}  // namespace fracbench
