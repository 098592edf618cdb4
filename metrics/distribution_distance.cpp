#include "metrics/distribution_distance.h"

#include <algorithm>
#include <cmath>

#include "core/sum.h"
#include "metrics/summary.h"

namespace fracbench {
namespace {

// Walks the merged values of two samples; calls step(low, high, F_a - F_b) for each stretch between
// neighbouring values, on which both distribution functions are constant.
template <typename Step>
void walk_differences(std::span<const double> a, std::span<const double> b, const Step& step) {
  const std::vector<double> x = sorted(a);
  const std::vector<double> y = sorted(b);
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < x.size() || j < y.size()) {
    const double here = j == y.size() || (i < x.size() && x[i] <= y[j]) ? x[i] : y[j];
    while (i < x.size() && x[i] == here) ++i;
    while (j < y.size() && y[j] == here) ++j;
    if (i == x.size() && j == y.size()) break;
    const double next = j == y.size() || (i < x.size() && x[i] <= y[j]) ? x[i] : y[j];
    step(here, next,
         static_cast<double>(i) / static_cast<double>(x.size()) -
             static_cast<double>(j) / static_cast<double>(y.size()));
  }
}

// Mott's law at a volume: the share above it and the integral of that share from there on.
struct Above {
  double volume;
  double share;
  double integral;
};

Above above(const Mott& law, double volume) {
  return {volume, law.survival(volume), law.survival_integral(volume)};
}

// Integral of |p - F| between two volumes for a constant p.
double area_beside(const Mott& law, double p, const Above& low, const Above& high) {
  // F - p = (1 - p) - S, whose integral needs that of S only.
  const auto area = [&](const Above& from, const Above& to) {
    return std::abs((1 - p) * (to.volume - from.volume) - (from.integral - to.integral));
  };
  const bool crosses = low.share > 1 - p && 1 - p > high.share;
  if (!crosses) return area(low, high);
  const Above crossing = above(law, std::clamp(law.quantile(p), low.volume, high.volume));
  return area(low, crossing) + area(crossing, high);
}

}  // namespace

std::vector<double> truncated(std::span<const double> values, double cut) {
  std::vector<double> above;
  std::ranges::copy_if(values, std::back_inserter(above), [&](double v) { return v > cut; });
  return above;
}

double kolmogorov_smirnov(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  walk_differences(a, b, [&](double, double, double difference) {
    largest = std::max(largest, std::abs(difference));
  });
  return largest;
}

double kolmogorov_smirnov(std::span<const double> sample,
                          const std::function<double(double)>& distribution) {
  const std::vector<double> x = sorted(sample);
  const auto n = static_cast<double>(x.size());
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double f = distribution(x[i]);
    largest =
        std::max({largest, f - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - f});
  }
  return largest;
}

double wasserstein(std::span<const double> a, std::span<const double> b) {
  Sum area;
  walk_differences(a, b, [&](double low, double high, double difference) {
    area += std::abs(difference) * (high - low);
  });
  return area.value();
}

double wasserstein(std::span<const double> sample, const Mott& law) {
  const std::vector<double> x = sorted(sample);
  const auto n = static_cast<double>(x.size());
  Sum area;
  Above low = above(law, law.cut);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Above high = above(law, x[i]);
    area += area_beside(law, static_cast<double>(i) / n, low, high);
    low = high;
  }
  area += low.integral;
  return area.value();
}

}  // namespace fracbench
