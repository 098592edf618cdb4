#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/report_item.h"
#include "reports/sections.h"

namespace fracbench {

constexpr int kThumbnail = 160;  ///< width and height of a picture on the page, px

/// What the page can show beside sections.
struct PageOptions {
  bool script = true;  ///< page.js is beside it; else tables do not sort and there is no viewer
  /// Keys of the cells that there is a file cells/<key>.js for, which the viewer shows.
  std::vector<std::string> viewed = {};
  std::size_t cells = 0;  ///< that the results have, where the input has not all of them
  bool pictures = false;  ///< there is pictures/<picture_name>.png for each picture of sheet_rows
  bool meshes = false;    ///< there is cells/<key>.glb for each of `viewed`
  std::vector<std::string> commands = {};  ///< that make the results and this report
};

/// index.html: the sections with their tables and figures, a table of the input's cells, the
/// viewer's place and the provenance. Everything can be read without a script, and nothing comes
/// from a network.
std::string html_page(const ReportInput& input, const std::vector<NamedSection>& sections,
                      const PageOptions& options);

}  // namespace fracbench
