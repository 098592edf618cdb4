#include "metrics/mott.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "metrics/summary.h"

namespace fracbench {
namespace {

// x = cbrt(6 V / Vbar) is exponentially distributed with mean 1.
double to_exponential(double volume, double mean_volume) {
  return std::cbrt(6 * volume / mean_volume);
}

// Of the formula as printed, without a cut. At V = 0 the exponent is -infinity.
double printed(double volume, double mean_volume) {
  return volume <= 0 ? 0 : std::exp(-6 / mean_volume / std::cbrt(volume));
}

}  // namespace

double Mott::survival(double volume) const {
  if (volume <= cut) return 1;
  return std::exp(to_exponential(cut, mean_volume) - to_exponential(volume, mean_volume));
}

double Mott::quantile(double p) const {
  const double x = to_exponential(cut, mean_volume) - std::log1p(-p);
  return std::max(cut, mean_volume * x * x * x / 6);
}

double Mott::survival_integral(double from) const {
  // dV = (Vbar / 2) x^2 dx, and the integral of x^2 exp(-x) from x on is (x^2 + 2 x + 2) exp(-x).
  const double start = std::max(from, cut);
  const double x = to_exponential(start, mean_volume);
  return mean_volume / 2 * (x * x + 2 * x + 2) * survival(start) + (start - from);
}

std::optional<Mott> Mott::with_mean(double mean_above, double cut) {
  if (!(mean_above > cut) || cut < 0 || !std::isfinite(mean_above)) return std::nullopt;
  if (cut == 0) return Mott{.mean_volume = mean_above};
  // mean / cut = 1 + 3 y + 6 y^2 + 6 y^3 at y = cbrt(Vbar / (6 cut)). The right side rises and is
  // convex for y > 0: Newton's steps from above fall towards the root and cannot pass it, until
  // rounding ends their fall.
  const double excess = mean_above / cut - 1;
  double y = std::min(excess / 3, std::cbrt(excess / 6));
  for (double last = 2 * y; y < last;) {
    last = y;
    y -= (y * (3 + y * (6 + y * 6)) - excess) / (3 + y * (12 + y * 18));
  }
  return Mott{.mean_volume = 6 * cut * y * y * y, .cut = cut};
}

std::optional<Mott> Mott::fit(std::span<const double> volumes, double cut) {
  std::vector<double> above;
  std::ranges::copy_if(volumes, std::back_inserter(above), [&](double v) { return v > cut; });
  if (above.empty()) return std::nullopt;
  return with_mean(summarize(above).mean, cut);
}

double MottAsPrinted::distribution(double volume) const {
  if (volume <= cut) return 0;
  const double below = printed(cut, mean_volume);
  return (printed(volume, mean_volume) - below) / (1 - below);
}

double MottAsPrinted::quantile(double p) const {
  const double below = printed(cut, mean_volume);
  const double q = below + p * (1 - below);
  if (q <= 0) return cut;
  const double root = 6 / mean_volume / -std::log(q);
  return std::max(cut, root * root * root);
}

}  // namespace fracbench
