#include "core/adjusted_rand_index.h"

namespace fracbench {

namespace {

double pairs(double n) { return n * (n - 1) / 2; }

double sum_of_pairs(const auto& counts) {
  double sum = 0;
  for (const auto& [label, count] : counts) sum += pairs(static_cast<double>(count));
  return sum;
}

}  // namespace

double adjusted_rand_index(const Contingency& counts) {
  const auto count = static_cast<double>(counts.all);
  const double together = sum_of_pairs(counts.both);
  const double a_pairs = sum_of_pairs(counts.a);
  const double b_pairs = sum_of_pairs(counts.b);
  const double largest = (a_pairs + b_pairs) / 2;
  const double by_chance = count < 2 ? largest : a_pairs * b_pairs / pairs(count);
  return largest == by_chance ? 1 : (together - by_chance) / (largest - by_chance);
}

double adjusted_rand_index(std::span<const std::int32_t> a, std::span<const std::int32_t> b) {
  return adjusted_rand_index(contingency(a, b));
}

}  // namespace fracbench
