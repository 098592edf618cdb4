#pragma once

#include <cstddef>
#include <string>

#include "core/triangle_mesh.h"
#include "harness/record.h"

namespace fracbench {

struct CellViewOptions {
  std::size_t faces = 12000;  ///< of all fragments together, about
};

/// What the page's viewer needs of a record, as a script that hands it over: a file that a page
/// from a disk may load, which plain data may not be. `target` is shown where nothing broke.
/// Layout: see docs/report-page.md.
std::string cell_view(const Record& record, const TriangleMesh& target,
                      const CellViewOptions& options = {});

/// What such a file begins with; another version of the layout begins otherwise.
std::string cell_view_head(std::string_view key);

}  // namespace fracbench
