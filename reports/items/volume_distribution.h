#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// Fragment volumes (figure 10, left): distances to Mott's law and between methods, left-truncated
/// at a common volume, and the curves themselves.
class VolumeDistribution final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
