#include "metrics/rerun_noise.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>

#include "core/sum.h"
#include "metrics/summary.h"

namespace fracbench {
namespace {

std::vector<std::vector<std::size_t>> members_of(std::span<const std::size_t> groups) {
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < groups.size(); ++i) members[groups[i]].push_back(i);
  std::vector<std::vector<std::size_t>> list;
  for (auto& [group, items] : members) list.push_back(std::move(items));
  return list;
}

double student_quantile(double p, std::size_t pairs) {
  const boost::math::students_t law(static_cast<double>(pairs - 1));
  return boost::math::quantile(law, p);
}

}  // namespace

double mean_difference_error(std::span<const double> values, std::span<const std::size_t> groups) {
  Sum squares;
  std::size_t freedom = 0;
  for (const auto& members : members_of(groups)) {
    if (members.size() < 2) continue;
    std::vector<double> alike;
    for (const std::size_t i : members) alike.push_back(values[i]);
    squares += summarize(alike).variance * static_cast<double>(alike.size() - 1);
    freedom += alike.size() - 1;
  }
  if (freedom == 0) return 0;
  const double variance = squares.value() / static_cast<double>(freedom);
  return std::sqrt(2 * variance / static_cast<double>(values.size()));
}

std::vector<double> distances_by_chance(const Clusters& clusters,
                                        std::span<const std::size_t> groups, Distance distance,
                                        std::size_t draws, Random& random) {
  struct Value {
    double value;
    std::size_t cluster;
  };
  std::vector<Value> values;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    for (const double value : clusters[c]) values.push_back({value, c});
  }
  std::ranges::stable_sort(values, {}, &Value::value);
  const auto members = members_of(groups);
  const auto n = static_cast<double>(clusters.size());
  const double freedom = n - static_cast<double>(members.size());
  if (freedom < 1 || values.empty()) return {};

  std::vector<double> distances;
  std::vector<double> weight[2];
  for (std::size_t draw = 0; draw < draws; ++draw) {
    double total[2] = {0, 0};
    for (int side = 0; side < 2; ++side) {
      weight[side].assign(clusters.size(), 0);
      for (const auto& group : members) {
        for (std::size_t i = 0; i < group.size(); ++i) {
          const std::size_t chosen = group[random.below(group.size())];
          ++weight[side][chosen];
          total[side] += static_cast<double>(clusters[chosen].size());
        }
      }
    }
    if (total[0] == 0 || total[1] == 0) continue;
    double below[2] = {0, 0};
    double result = 0;
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
      for (int side = 0; side < 2; ++side) below[side] += weight[side][values[i].cluster];
      const double step = values[i + 1].value - values[i].value;
      if (step == 0) continue;
      const double difference = std::abs(below[0] / total[0] - below[1] / total[1]);
      result = distance == Distance::kolmogorov_smirnov ? std::max(result, difference)
                                                        : result + difference * step;
    }
    distances.push_back(result * std::sqrt(n / freedom));
  }
  std::ranges::sort(distances);
  return distances;
}

double shift_by_chance(double error, std::size_t pairs, double significance, Tail tail) {
  if (error == 0 || pairs < 2) return 0;
  return error *
         student_quantile(1 - (tail == Tail::both ? significance / 2 : significance), pairs);
}

double detectable_shift(double error, std::size_t pairs, double significance, double threshold,
                        Tail tail, double power) {
  if (error == 0 || pairs < 2) return threshold;
  return std::max(threshold, shift_by_chance(error, pairs, significance, tail)) +
         error * student_quantile(power, pairs);
}

}  // namespace fracbench
