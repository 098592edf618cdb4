#include "methods/cvd/sites.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/sum.h"

namespace fracbench::cvd {

namespace {

constexpr std::size_t kChunk = 1024;

struct Nearest {
  std::int32_t site = 0;
  double squared_distance = 0;
};

// Sites in order of one coordinate: the search goes outwards from the sample's own place and ends
// where that coordinate alone is farther than the best so far.
class SiteOrder {
 public:
  explicit SiteOrder(std::span<const Vec3> sites) {
    for (std::size_t s = 0; s < sites.size(); ++s) {
      order_.push_back({sites[s], static_cast<std::int32_t>(s)});
    }
    Vec3 low = sites[0], high = sites[0];
    for (const Vec3& site : sites) {
      low = low.cwiseMin(site);
      high = high.cwiseMax(site);
    }
    (high - low).maxCoeff(&axis_);
    std::ranges::sort(order_, [&](const Entry& a, const Entry& b) {
      return a.point[axis_] != b.point[axis_] ? a.point[axis_] < b.point[axis_] : a.site < b.site;
    });
  }

  Nearest find(const Vec3& x) const {
    Nearest best{0, std::numeric_limits<double>::infinity()};
    const auto try_site = [&](const Entry& entry) {
      const double along = entry.point[axis_] - x[axis_];
      if (along * along > best.squared_distance) return false;
      const double distance = (entry.point - x).squaredNorm();
      if (distance < best.squared_distance ||
          (distance == best.squared_distance && entry.site < best.site)) {
        best = {entry.site, distance};
      }
      return true;
    };
    const auto middle = std::ranges::lower_bound(
        order_, x[axis_], {}, [&](const Entry& entry) { return entry.point[axis_]; });
    for (auto up = middle; up != order_.end() && try_site(*up);) ++up;
    for (auto down = middle; down != order_.begin() && try_site(*(down - 1));) --down;
    return best;
  }

 private:
  struct Entry {
    Vec3 point;
    std::int32_t site;
  };
  std::vector<Entry> order_;
  int axis_ = 0;
};

std::vector<Nearest> nearest_sites(std::span<const Vec3> points, std::span<const Vec3> sites,
                                   int threads) {
  std::vector<Nearest> nearest(points.size());
  const SiteOrder order(sites);
  parallel_for((points.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    const std::size_t end = std::min(points.size(), (chunk + 1) * kChunk);
    for (std::size_t p = chunk * kChunk; p < end; ++p) nearest[p] = order.find(points[p]);
  });
  return nearest;
}

double energy_of(const WeightedSamples& samples, const std::vector<Nearest>& nearest) {
  Sum energy;
  for (std::size_t p = 0; p < nearest.size(); ++p) {
    energy += samples.weights[p] * nearest[p].squared_distance;
  }
  return energy.value();
}

}  // namespace

WeightedSamples density(std::span<const Vec3> points, const Vec3& center, double falloff) {
  WeightedSamples samples{points, std::vector<double>(points.size(), 1)};
  if (falloff <= 0) return samples;
  // Only ratios count: relative to the nearest sample nothing underflows that matters.
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& point : points) nearest = std::min(nearest, (point - center).norm());
  for (std::size_t p = 0; p < points.size(); ++p) {
    samples.weights[p] = std::exp((nearest - (points[p] - center).norm()) / falloff);
  }
  return samples;
}

std::vector<Vec3> draw_sites(const WeightedSamples& samples, std::size_t count, Random& random) {
  // The `count` largest of log(u) / weight.
  std::vector<std::pair<double, std::size_t>> keys;
  keys.reserve(samples.points.size());
  for (std::size_t p = 0; p < samples.points.size(); ++p) {
    const double weight = std::max(samples.weights[p], std::numeric_limits<double>::min());
    keys.emplace_back(-std::log(1 - random.uniform()) / weight, p);
  }
  std::ranges::partial_sort(keys, keys.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<Vec3> sites;
  for (std::size_t s = 0; s < count; ++s) sites.push_back(samples.points[keys[s].second]);
  return sites;
}

Relaxation lloyd(const WeightedSamples& samples, std::vector<Vec3> sites, int iterations,
                 int threads) {
  Relaxation result{std::move(sites), {}};
  for (int n = 0; n < iterations; ++n) {
    const auto nearest = nearest_sites(samples.points, result.sites, threads);
    result.energy.push_back(energy_of(samples, nearest));
    std::vector<Vec3> sums(result.sites.size(), Vec3::Zero());
    std::vector<double> weights(result.sites.size(), 0);
    for (std::size_t p = 0; p < nearest.size(); ++p) {
      sums[nearest[p].site] += samples.weights[p] * samples.points[p];
      weights[nearest[p].site] += samples.weights[p];
    }
    for (std::size_t s = 0; s < sums.size(); ++s) {
      if (weights[s] > 0) result.sites[s] = sums[s] / weights[s];
    }
  }
  result.energy.push_back(energy_of(samples, nearest_sites(samples.points, result.sites, threads)));
  return result;
}

}  // namespace fracbench::cvd
