#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// Tables 1 and 2 of the paper beside our own, with a verdict for each value.
class PaperTables final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
