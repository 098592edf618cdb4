#include "metrics/locality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "geometry/measures.h"
#include "metrics/measurement.h"

namespace fracbench {

namespace {

/// Ranks from 1; equal values share their mean rank.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<double> result(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i;
    while (j < order.size() && values[order[j]] == values[order[i]]) ++j;
    for (std::size_t k = i; k < j; ++k) result[order[k]] = static_cast<double>(i + j + 1) / 2;
    i = j;
  }
  return result;
}

/// Pearson's correlation; NaN where one of them does not vary.
double correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0;
  double yy = 0;
  double xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (!(xx > 0) || !(yy > 0)) return std::numeric_limits<double>::quiet_NaN();
  return xy / std::sqrt(xx * yy);
}

}  // namespace

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
  add_value(result, "size_distance_correlation", correlation(ranks(volumes), ranks(distances)));
  return result;
}

}  // namespace fracbench
