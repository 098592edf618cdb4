#include "metrics/clustered_distance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/metrics/collision_generator.h"

namespace fracbench {
namespace {

using synthetic::CollisionGenerator;

double p_of(const Clusters& a, const Clusters& b, Distance distance, std::uint64_t seed) {
  Random random(seed);
  return distance_test(ClusteredDistance(a, b, distance), {.draws = 999}, random).p;
}

/// Each value as a collision of its own: wrong, since those of one collision depend on each other.
Clusters as_single_values(const Clusters& clusters) {
  Clusters single;
  for (const auto& cluster : clusters) {
    for (const double value : cluster) single.push_back({value});
  }
  return single;
}

int alarms(Distance distance, bool whole) {
  const CollisionGenerator generator{.collisions = 20, .within = 0.5};
  int alarmed = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Clusters a = generator.run(i, 2 * i);
    const Clusters b = generator.run(i, 2 * i + 1);
    const double p = whole ? p_of(a, b, distance, i)
                           : p_of(as_single_values(a), as_single_values(b), distance, i);
    alarmed += p <= 0.01;
  }
  return alarmed;
}

TEST(ClusteredDistance, NewSeedsAlarmInAtMostThirteenOfFiveHundredComparisons) {
  for (const Distance distance : {Distance::kolmogorov_smirnov, Distance::wasserstein}) {
    const int alarmed = alarms(distance, true);
    fmt::print("{} of 500 comparisons alarm\n", alarmed);
    EXPECT_LE(alarmed, 13);
  }
}

TEST(ClusteredDistance, SwappingSingleFragmentsInsteadAlarmsFarTooOften) {
  EXPECT_GT(alarms(Distance::kolmogorov_smirnov, false), 50);
}

TEST(ClusteredDistance, PowerGrowsWithShiftAndCollisions) {
  constexpr int kRounds = 50;
  const std::vector<double> shifts = {1.1, 1.2, 1.4, 2};
  for (const Distance distance : {Distance::kolmogorov_smirnov, Distance::wasserstein}) {
    std::vector<double> fewer(shifts.size(), 0);
    for (const std::size_t collisions : {20, 40, 80}) {
      const CollisionGenerator generator{.collisions = collisions};
      fmt::print("{:>4} collisions:", collisions);
      double last = 0;
      for (std::size_t s = 0; s < shifts.size(); ++s) {
        double found = 0;
        for (std::uint64_t i = 0; i < kRounds; ++i) {
          found += p_of(generator.run(i, 2 * i), generator.run(i, 2 * i + 1, shifts[s]), distance,
                        i) <= 0.01;
        }
        found /= kRounds;
        fmt::print(" {:.2f} at {}", found, shifts[s]);
        EXPECT_GE(found, last - 0.1);
        EXPECT_GE(found, fewer[s] - 0.1);
        last = fewer[s] = found;
      }
      fmt::print("\n");
      EXPECT_EQ(last, 1);
    }
  }
}

}  // namespace
}  // namespace fracbench
