#pragma once

#include <cstddef>
#include <vector>

#include "harness/cell_summary.h"

namespace fracbench {

/// The cells that a page shows one by one, in their order: all of them, or where they are more than
/// `most` the first collisions of each shape, as many of each, and always all methods under one
/// impact. At least one collision.
std::vector<CellSummary> shown_cells(const std::vector<CellSummary>& cells, std::size_t most);

}  // namespace fracbench
