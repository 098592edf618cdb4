#pragma once

#include <span>
#include <string>
#include <vector>

#include "reports/report_item.h"

namespace fracbench {

/// A section of a report with what it is called.
struct NamedSection {
  ReportItemInfo item;
  ReportSection section;
};

/// The sections of all items that have something to show, in their order; with `names`, of those
/// alone. Throws InputError for a name that is not there, with the nearest one.
std::vector<NamedSection> render_sections(const ReportInput& input,
                                          std::span<const std::string> names = {});

}  // namespace fracbench
