#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// What stands for a divided image so that a network can learn it: labels, lines or distances
/// (supplement, section 6 and figure 7 of the DeepFracture paper). From the study of a suite.
class Representations : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
