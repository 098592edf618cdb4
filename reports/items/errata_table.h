#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// What is wrong or undefined in the paper, and what follows for this report.
class ErrataTable final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
