#pragma once

#include <memory>
#include <vector>

#include "reports/report_item.h"

namespace fracbench {

/// All items, in the order of the report.
const std::vector<std::unique_ptr<ReportItem>>& report_items();

}  // namespace fracbench
