#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// What the paper says of methods beside each other (reports/published/claims.toml), as statistics
/// with intervals and a verdict on their sign.
class ClaimsTable final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
