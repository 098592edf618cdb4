#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// How well the fragments of each method agree with those of the reference under the same impacts,
/// between a floor and a ceiling.
class LabelAgreementTable final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
