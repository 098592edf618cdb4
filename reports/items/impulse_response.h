#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// What impacts do by their strength (supplement, figures 1, 2 and 9): fragments and the largest of
/// them against the impulse, and the impulses themselves, largest and second largest.
class ImpulseResponse final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
