#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// How well methods learned: loss of each epoch, training patterns that come back from exact fields
/// (the ceiling) and from decoded ones, how often chance chooses. From the series
/// `<method>_training_loss`, `_round_trip`, `_decoded` and `_other_rows` of records.
class Training : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
