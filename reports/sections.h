#pragma once

#include <string>
#include <vector>

#include "reports/report_item.h"

namespace fracbench {

/// A section of a report with what it is called.
struct NamedSection {
  ReportItemInfo item;
  ReportSection section;
};

/// The sections of all items that have something to show, in their order.
std::vector<NamedSection> render_sections(const ReportInput& input);

}  // namespace fracbench
