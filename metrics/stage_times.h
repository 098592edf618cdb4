#pragma once

#include "metrics/metric.h"

namespace fracbench {

/// Share of the total that the stages may miss, or exceed it by.
inline constexpr double kStageCoverageTolerance = 0.02;

/// `stage_<name>`: wall-clock seconds of each stage, in the order in which they began;
/// `total_seconds`: of the whole cell; `stage_coverage`: sum of the stages over the total, which
/// must be within 2 % of 1, so that no time is hidden between the stages.
class StageTimes final : public Metric {
 public:
  MetricInfo info() const override;
  Measurement measure(const CellResult& cell) const override;
};

/// Whether the stages of a measurement account for its total.
bool stages_add_up(const Measurement& measurement);

}  // namespace fracbench
