#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// How the cells of each method and shape ended, and why some did not end well.
class Overview final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
