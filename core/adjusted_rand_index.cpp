#include "core/adjusted_rand_index.h"

#include <map>
#include <stdexcept>
#include <utility>

namespace fracbench {

namespace {

double pairs(double n) { return n * (n - 1) / 2; }

template <typename Label>
double sum_of_pairs(const std::map<Label, double>& cells) {
  double sum = 0;
  for (const auto& [label, count] : cells) sum += pairs(count);
  return sum;
}

}  // namespace

double adjusted_rand_index(std::span<const std::int32_t> a, std::span<const std::int32_t> b) {
  if (a.size() != b.size()) throw std::invalid_argument("labellings of different lengths");
  std::map<std::pair<std::int32_t, std::int32_t>, double> in_both;
  std::map<std::int32_t, double> in_a, in_b;
  double count = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    if (a[n] < 0 || b[n] < 0) continue;
    ++in_both[{a[n], b[n]}];
    ++in_a[a[n]];
    ++in_b[b[n]];
    ++count;
  }
  const double together = sum_of_pairs(in_both);
  const double a_pairs = sum_of_pairs(in_a);
  const double b_pairs = sum_of_pairs(in_b);
  const double largest = (a_pairs + b_pairs) / 2;
  const double by_chance = count < 2 ? largest : a_pairs * b_pairs / pairs(count);
  return largest == by_chance ? 1 : (together - by_chance) / (largest - by_chance);
}

}  // namespace fracbench
