#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/random.h"

namespace fracbench {

/// Tests of whether two runs over the same collisions differ. The two results of one collision
/// (baseline and candidate) are exchangeable where nothing has changed, so each may be swapped with
/// the other without changing the law of the data (Fisher, "The design of experiments", 1935,
/// section 21). A collision is swapped as a whole, with all of its fragments, which depend on each
/// other; differences between collisions cancel, since nothing moves from one to another.

enum class Tail : std::uint8_t {
  both,   ///< any difference
  upper,  ///< the candidate is larger
  lower,  ///< the candidate is smaller
};

struct PermutationOptions {
  /// Most swaps that are drawn; all 2^n are counted instead where there are no more of them.
  std::size_t draws = 9999;
  /// Drawing stops early after this many swaps as extreme as the data: the p-value is large, and
  /// stays valid (Besag and Clifford, "Sequential Monte Carlo p-values", 1991).
  std::size_t enough = 30;
};

struct PermutationResult {
  double p = 1;
  bool exact = false;     ///< all swaps were counted
  std::size_t draws = 0;  ///< how many were
};

/// How extreme the data are after some collisions were swapped (1) and others not (0).
using SwapStatistic = std::function<double(std::span<const std::uint8_t> swapped)>;

/// The share of swaps whose statistic is at least that of the data, the data themselves counted.
/// Statistics that differ by less than one part in 10^10 count as equal.
PermutationResult swap_test(std::size_t pairs, const SwapStatistic& statistic,
                            const PermutationOptions& options, Random& random);

/// Whether the mean of differences (candidate - baseline, one for each collision) is zero.
PermutationResult sign_flip_test(std::span<const double> differences, Tail tail,
                                 const PermutationOptions& options, Random& random);

/// The smallest p-value that any data of this many pairs can have: 2^-n, twice that for both tails
/// and for distances between distributions, which do not tell the two sides apart.
double smallest_p(std::size_t pairs, Tail tail);

/// p-values corrected for the number of tests (Holm, "A simple sequentially rejective multiple test
/// procedure", 1979): rejecting those at most alpha errs in any of them with probability alpha at
/// most, whatever their dependence. In the order given.
std::vector<double> holm(std::span<const double> p);

}  // namespace fracbench
