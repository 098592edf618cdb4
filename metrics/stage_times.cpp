#include "metrics/stage_times.h"

#include <algorithm>
#include <cmath>

#include "core/sum.h"
#include "metrics/measurement.h"

namespace fracbench {

MetricInfo StageTimes::info() const {
  return {.name = "stage_times",
          .summary = "seconds in each stage, and how much of the total they account for",
          .of_machine = true};
}

Measurement StageTimes::measure(const CellResult& cell) const {
  Measurement result;
  Sum sum;
  for (const StageTime& stage : cell.stages) {
    sum += stage.seconds;
    add_value(result, "stage_" + stage.name, stage.seconds, "s");
  }
  add_value(result, "total_seconds", cell.total_seconds, "s");
  if (cell.total_seconds > 0) add_value(result, "stage_coverage", sum.value() / cell.total_seconds);
  return result;
}

bool stages_add_up(const Measurement& measurement) {
  const auto found =
      std::ranges::find(measurement.values, std::string("stage_coverage"), &MetricValue::name);
  return found != measurement.values.end() && std::abs(found->value - 1) <= kStageCoverageTolerance;
}

}  // namespace fracbench
