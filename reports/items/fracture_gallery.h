#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// Pictures of one collision of each shape by every method, with the detail of the fracture surface
/// (figures 8 and 9; supplement, figure 13).
class FractureGallery : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
