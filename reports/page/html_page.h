#pragma once

#include <string>
#include <vector>

#include "reports/report_item.h"
#include "reports/sections.h"

namespace fracbench {

/// What the page can show beside sections.
struct PageOptions {
  bool script = true;  ///< page.js is beside it; else tables do not sort and there is no viewer
  /// Keys of the cells that there is a file cells/<key>.js for, which the viewer shows.
  std::vector<std::string> viewed = {};
  std::vector<std::string> commands = {};  ///< that make the results and this report
};

/// index.html: the sections with their tables and figures, a table of all cells, the viewer's place
/// and the provenance. Everything can be read without a script, and nothing comes from a network.
std::string html_page(const ReportInput& input, const std::vector<NamedSection>& sections,
                      const PageOptions& options);

}  // namespace fracbench
