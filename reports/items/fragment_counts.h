#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// Fragments per collision (figure 10, right), with intervals over whole collisions.
class FragmentCounts final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
