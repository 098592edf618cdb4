#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// One line per cell: what it is, how it ended, and every value that any cell has.
Table cells_table(const ReportInput& input);

/// One line per fragment of every cell: its volume, the body's being 10.
Table volumes_table(const ReportInput& input);

}  // namespace fracbench
