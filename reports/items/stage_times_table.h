#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// Where the time goes, beside the published times (table 2).
class StageTimesTable final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
