#include <fmt/format.h>
#include <gtest/gtest.h>

#include "harness/compare.h"
#include "tests/harness/made_up_results.h"

/// False alarms and power of the whole comparison, on a generator whose variation is known.
namespace fracbench {
namespace {

bool alarms(const Results& baseline, const MadeUpResults& candidate,
            const std::vector<Gate>& gates) {
  return compare_results(baseline, candidate.make(), gates).exit_code == ExitCode::regression;
}

/// Limits so small that nothing but the significance holds alarms back.
std::vector<Gate> strict_gates() {
  const auto mean = [](std::string metric) {
    return Gate{.metric = std::move(metric), .limit = 1e-15};
  };
  std::vector<Gate> gates = {
      mean("fragment_count"),
      mean("normal_along"),
      mean("roughness"),
      mean("volume_ratio"),
      {.metric = "fragment_volume", .test = GateTest::kolmogorov_smirnov, .limit = 1e-15},
      {.metric = "fragment_volume", .test = GateTest::wasserstein, .limit = 1e-15},
      {.metric = "total_seconds",
       .test = GateTest::paired_ratio,
       .limit = 1 + 1e-12,
       .relative = true}};
  for (Gate& gate : gates) gate.raise_to_noise = true;
  return gates;
}

TEST(ComparePower, SameSeedsNeverAlarm) {
  int alarmed = 0;
  for (std::uint64_t i = 0; i < 50; ++i) {
    const MadeUpResults law{.seed = i, .rerun = 2 * i};
    MadeUpResults again = law;
    again.rerun = 2 * i + 1;
    alarmed += alarms(law.make(), again, default_gates());
  }
  EXPECT_EQ(alarmed, 0);
}

TEST(ComparePower, NewSeedsAlarmInAtMostThirteenOfFiveHundredComparisons) {
  // Thirteen is what a true 1 % exceeds in one of a thousand such tests.
  for (const bool strict : {false, true}) {
    int alarmed = 0;
    for (std::uint64_t i = 0; i < 500; ++i) {
      // Repeats make the noise tight, so that limits do not hide what significance lets through.
      const MadeUpResults law{.collisions = 12, .repeats = 2, .seed = 2 * i, .rerun = 2 * i};
      MadeUpResults other = law;
      other.seed = other.rerun = 2 * i + 1;
      alarmed += alarms(law.make(), other, strict ? strict_gates() : default_gates());
    }
    fmt::print("new seeds, {} gates: {} of 500 comparisons alarm\n", strict ? "strict" : "default",
               alarmed);
    EXPECT_LE(alarmed, 13);
  }
}

struct Power {
  double found = 0;   ///< share of comparisons
  double stated = 0;  ///< mean of the smallest change that gates state to find with 95 %
};

constexpr int kRounds = 50;

Power power(std::size_t collisions, double shift) {
  std::vector<Gate> gates = default_gates();
  std::erase_if(gates, [](const Gate& gate) { return gate.metric == "fragment_volume"; });  // slow
  Power result;
  for (int round = 0; round < kRounds; ++round) {
    const auto seed = static_cast<std::uint64_t>(round);
    const MadeUpResults law{.collisions = collisions / 2, .repeats = 2, .seed = 2 * seed};
    MadeUpResults shifted = law;
    shifted.seed = 2 * seed + 1;
    shifted.count_shift = shift;
    const Comparison comparison = compare_results(law.make(), shifted.make(), gates);
    result.found += comparison.gates[0].outcome == GateOutcome::regression;
    result.stated += comparison.gates[0].detectable.value_or(0);
  }
  return {result.found / kRounds, result.stated / kRounds};
}

TEST(ComparePower, GrowsWithShiftAndCollisionsAndIsWhatTheGateStates) {
  fmt::print("share of comparisons that find a change of fragment_count\n");
  fmt::print("{:>10}", "collisions");
  const std::vector<double> shifts = {1.05, 1.1, 1.15, 1.2, 1.3, 1.5};
  for (const double shift : shifts) fmt::print("{:>7}", shift);
  fmt::print("{:>12}{:>14}\n", "stated 95 %", "found there");
  std::vector<double> before(shifts.size(), 0);
  for (const std::size_t collisions : {20, 40, 80}) {
    fmt::print("{:>10}", collisions);
    double stated = 0;
    double last = 0;
    for (std::size_t i = 0; i < shifts.size(); ++i) {
      const Power at = power(collisions, shifts[i]);
      fmt::print("{:>7.2f}", at.found);
      EXPECT_GE(at.found, last - 0.1);
      if (shifts[i] >= 1.15) {
        EXPECT_GE(at.found, before[i] - 0.1);
      }
      last = before[i] = at.found;
      stated = at.stated;
    }
    const double found = power(collisions, stated).found;
    fmt::print("{:>12.3f}{:>14.2f}\n", stated, found);
    EXPECT_GE(found, 0.88);  // 0.95 in 50 rounds, less 2.3 standard errors
    EXPECT_EQ(last, 1);
  }
}

}  // namespace
}  // namespace fracbench
