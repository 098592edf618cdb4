#include "metrics/paired_permutation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/sum.h"

namespace fracbench {
namespace {

// Sums in another order differ in their last bits; what is equal by symmetry must count as equal.
constexpr double kRounding = 1e-10;

// 2^20 statistics are too many for a gate; more are drawn instead.
constexpr std::size_t kMostCounted = 20;

}  // namespace

PermutationResult swap_test(std::size_t pairs, const SwapStatistic& statistic,
                            const PermutationOptions& options, Random& random) {
  std::vector<std::uint8_t> swapped(pairs, 0);
  const double observed = statistic(swapped);
  const double bound = observed - kRounding * std::abs(observed);
  if (pairs <= kMostCounted && (std::size_t{1} << pairs) <= options.draws) {
    const std::size_t all = std::size_t{1} << pairs;
    std::size_t extreme = 0;
    for (std::size_t bits = 0; bits < all; ++bits) {
      for (std::size_t i = 0; i < pairs; ++i) swapped[i] = (bits >> i) & 1;
      extreme += statistic(swapped) >= bound ? 1 : 0;
    }
    return {
        .p = static_cast<double>(extreme) / static_cast<double>(all), .exact = true, .draws = all};
  }
  std::size_t extreme = 0;
  for (std::size_t drawn = 1; drawn <= options.draws; ++drawn) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
      if (i % 64 == 0) bits = random.bits();
      swapped[i] = (bits >> (i % 64)) & 1;
    }
    extreme += statistic(swapped) >= bound ? 1 : 0;
    if (extreme == options.enough) {
      return {.p = static_cast<double>(extreme) / static_cast<double>(drawn), .draws = drawn};
    }
  }
  return {.p = static_cast<double>(extreme + 1) / static_cast<double>(options.draws + 1),
          .draws = options.draws};
}

PermutationResult sign_flip_test(std::span<const double> differences, Tail tail,
                                 const PermutationOptions& options, Random& random) {
  const auto statistic = [&](std::span<const std::uint8_t> swapped) {
    double total = 0;
    for (std::size_t i = 0; i < differences.size(); ++i) {
      total += swapped[i] ? -differences[i] : differences[i];
    }
    return tail == Tail::both ? std::abs(total) : tail == Tail::upper ? total : -total;
  };
  return swap_test(differences.size(), statistic, options, random);
}

double smallest_p(std::size_t pairs, Tail tail) {
  const double one_sided = std::exp2(-static_cast<double>(pairs));
  return std::min(1.0, tail == Tail::both ? 2 * one_sided : one_sided);
}

std::vector<double> holm(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> corrected(p.size());
  double largest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    largest = std::max(largest, static_cast<double>(p.size() - rank) * p[order[rank]]);
    corrected[order[rank]] = std::min(1.0, largest);
  }
  return corrected;
}

}  // namespace fracbench
