#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/random.h"
#include "metrics/clustered_distance.h"

namespace fracbench {

/// What a second run over the same collisions with other random numbers would differ by, from one
/// run alone. Collisions come in groups of at least two that are alike: the repeats of one impact
/// where there are any, else the impacts of one shape. In the latter case the differences between
/// impacts are in the noise too, which is then too large rather than too small.

/// Standard error of mean(second) - mean(first): sqrt(2 s^2 / n) with the pooled variance s^2
/// within groups. Groups of one say nothing and are left out; 0 where all are.
double mean_difference_error(std::span<const double> values, std::span<const std::size_t> groups);

/// Distances between two runs that are both drawn, with replacement and group by group, from this
/// one, ascending; enlarged by sqrt(n / (n - groups)), since what is drawn from a sample varies
/// less than what the sample was drawn from.
std::vector<double> distances_by_chance(const Clusters& clusters,
                                        std::span<const std::size_t> groups, Distance distance,
                                        std::size_t draws, Random& random);

/// The shift of a mean that a test of this significance on `pairs` differences with standard error
/// `error` finds with probability `power`, given that it must also exceed `threshold`: sign flips
/// have the power of Student's t-test (Lehmann and Romano, "Testing statistical hypotheses",
/// section 15.2).
double detectable_shift(double error, std::size_t pairs, double significance, double threshold,
                        Tail tail, double power = 0.95);

/// What chance makes of no shift at all: exceeded with probability `significance`.
double shift_by_chance(double error, std::size_t pairs, double significance, Tail tail);

}  // namespace fracbench
