#include "metrics/locality.h"

#include "geometry/measures.h"
#include "metrics/measurement.h"
#include "metrics/rank_correlation.h"

namespace fracbench {

MetricInfo Locality::info() const {
  return {.name = "locality", .summary = "whether fragments near the impact are smaller"};
}

Measurement Locality::measure(const CellResult& cell) const {
  Measurement result;
  const auto fragments = measurable(cell.fragments);
  if (fragments.size() < 3 || cell.impacts.empty() || cell.impacts.front().impulses.empty()) {
    return result;
  }
  const Vec3& point = cell.impacts.front().impulses.front().point;
  std::vector<double> volumes;
  std::vector<double> distances;
  for (const Fragment& fragment : fragments) {
    const MassProperties mass = mass_properties(fragment.mesh);
    volumes.push_back(mass.volume);
    distances.push_back((mass.center - point).norm());
  }
  if (const auto correlation = rank_correlation(volumes, distances)) {
    add_value(result, "size_distance_correlation", *correlation);
  }
  return result;
}

}  // namespace fracbench
