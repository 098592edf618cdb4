#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// Whether the fragments are what the methods promise: the worst case of each.
class ValidityTable final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
