#include "metrics/fragment_volumes.h"

#include <cmath>

#include "geometry/measures.h"
#include "metrics/measurement.h"
#include "metrics/summary.h"

namespace fracbench {

MetricInfo FragmentVolumes::info() const {
  return {.name = "fragment_volumes", .summary = "volume of each fragment, the body's being 10"};
}

Measurement FragmentVolumes::measure(const CellResult& cell) const {
  const std::string unit = "V_body / 10";
  const double whole = volume(cell.body);
  MetricSeries series{.name = "fragment_volume", .values = {}, .unit = unit};
  for (const Fragment& fragment : measurable(cell.fragments)) {
    const double scaled = kParentVolume * volume(fragment.mesh) / whole;
    if (std::isfinite(scaled)) series.values.push_back(scaled);
  }
  Measurement result;
  if (series.values.empty()) return result;
  const Summary summary = summarize(series.values);
  add_value(result, "fragment_volume_mean", summary.mean, unit);
  add_value(result, "fragment_volume_median", quantile(series.values, 0.5).value(), unit);
  if (summary.count > 1) {
    add_value(result, "fragment_volume_deviation", summary.deviation(), unit);
  }
  add_value(result, "fragment_volume_largest", summary.maximum, unit);
  add_value(result, "fragment_volume_smallest", summary.minimum, unit);
  result.series.push_back(std::move(series));
  return result;
}

}  // namespace fracbench
