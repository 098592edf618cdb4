#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// Times of prediction, segmentation and cutting by the resolution of the grid (figure 11), where
/// cells of more than one resolution are there.
class ResolutionTimes final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
