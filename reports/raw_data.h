#pragma once

#include <string>

#include "reports/report_item.h"

namespace fracbench {

/// cells.csv: one line per cell: what it is, how it ended, and every value that any cell has.
std::string cells_csv(const ReportInput& input);

/// volumes.csv: one line per fragment of every cell: its volume, the body's being 10.
std::string volumes_csv(const ReportInput& input);

}  // namespace fracbench
