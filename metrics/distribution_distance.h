#pragma once

#include <functional>
#include <span>
#include <vector>

#include "metrics/mott.h"

namespace fracbench {

/// The values above `cut`: what is compared when two samples are left-truncated at a common volume.
std::vector<double> truncated(std::span<const double> values, double cut);

/// Kolmogorov-Smirnov distance, the largest difference of two distribution functions, in [0, 1]:
///   D = sup_v |F_a(v) - F_b(v)|.
/// Samples in any order, neither empty; ties within and between them are handled exactly.
double kolmogorov_smirnov(std::span<const double> a, std::span<const double> b);

/// The same between a sample and a continuous distribution function.
double kolmogorov_smirnov(std::span<const double> sample,
                          const std::function<double(double)>& distribution);

/// Wasserstein-1 (earth mover's) distance, the area between two distribution functions, in the unit
/// of the values:
///   W = integral of |F_a(v) - F_b(v)| dv.
/// Samples in any order, neither empty.
double wasserstein(std::span<const double> a, std::span<const double> b);

/// The same between a sample and Mott's law, from the closed form of its integral. Values at or
/// below the law's cut must have been left out. There is no such function for the law as printed:
/// its mean is infinite, and so is its distance to any sample.
double wasserstein(std::span<const double> sample, const Mott& law);

}  // namespace fracbench
