#include "harness/compare.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "tests/harness/made_up_results.h"

namespace fracbench {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const GateResult& gate_of(const Comparison& comparison, std::string_view metric) {
  for (const GateResult& gate : comparison.gates) {
    if (gate.gate.metric == metric) return gate;
  }
  throw std::logic_error("no such gate");
}

std::vector<Gate> count_gate(double factor) {
  return {{.metric = "fragment_count", .limit = factor, .relative = true}};
}

TEST(Compare, ARerunWithTheSameSeedsIsGood) {
  const Results baseline = MadeUpResults{}.make();
  const Comparison same =
      compare_results(baseline, MadeUpResults{.rerun = 2}.make(), default_gates());
  EXPECT_EQ(same.verdict, "good");
  EXPECT_EQ(same.exit_code, ExitCode::good);
  EXPECT_EQ(same.compared, 40u);
  EXPECT_THAT(same.problems, IsEmpty());
  EXPECT_EQ(gate_of(same, "fragment_count").change, 1);
  EXPECT_EQ(gate_of(same, "fragment_volume").change, 0);
  EXPECT_EQ(gate_of(same, "total_seconds").outcome, GateOutcome::pass);
  EXPECT_EQ(gate_of(same, "stage_other").outcome, GateOutcome::reported);
}

TEST(Compare, IdenticalMetricsAreGoodHoweverFew) {
  for (const std::size_t collisions : {1, 2, 5}) {
    const Results few = MadeUpResults{.collisions = collisions}.make();
    EXPECT_EQ(compare_results(few, few, default_gates()).verdict, "good") << collisions;
  }
}

TEST(Compare, TooFewCollisionsThatDifferAreNotMeasuredRatherThanPassed) {
  const MadeUpResults few{.collisions = 4};
  MadeUpResults other = few;
  other.seed = other.rerun = 2;
  const Comparison comparison = compare_results(few.make(), other.make(), default_gates());
  EXPECT_EQ(comparison.exit_code, ExitCode::not_measured);
  const GateResult& gate = gate_of(comparison, "fragment_count");
  EXPECT_EQ(gate.outcome, GateOutcome::not_measured);
  EXPECT_THAT(gate.reason, HasSubstr("4 collisions cannot show"));
  EXPECT_EQ(gate_of(comparison, "total_seconds").outcome, GateOutcome::reported);
}

TEST(Compare, LargeShiftsAreRegressionsOfTheGateTheyConcern) {
  const Results baseline = MadeUpResults{}.make();
  const auto failing = [&](const MadeUpResults& candidate) {
    const Comparison comparison = compare_results(baseline, candidate.make(), default_gates());
    EXPECT_EQ(comparison.exit_code, ExitCode::regression);
    std::vector<std::string> metrics;
    for (const GateResult& gate : comparison.gates) {
      if (gate.outcome == GateOutcome::regression) metrics.push_back(gate.gate.metric);
    }
    return metrics;
  };
  EXPECT_THAT(failing({.count_shift = 2, .seed = 2}), Contains("fragment_count"));
  EXPECT_THAT(failing({.count_shift = 0.4, .seed = 2}), Contains("fragment_count"));
  EXPECT_THAT(failing({.volume_shift = 1.5, .seed = 2}), Contains("fragment_volume"));
  EXPECT_THAT(failing({.time_shift = 3, .rerun = 2}),
              ::testing::UnorderedElementsAre("total_seconds", "stage_cut"));
}

TEST(Compare, AFactorAndASignificanceMustBothBeExceeded) {
  const Results baseline = MadeUpResults{.collisions = 200, .repeats = 2}.make();
  const Results more =
      MadeUpResults{.collisions = 200, .repeats = 2, .count_shift = 1.15, .seed = 2}.make();
  EXPECT_EQ(compare_results(baseline, more, count_gate(1.05)).verdict, "regression");
  const Comparison allowed = compare_results(baseline, more, count_gate(1.3));
  EXPECT_EQ(allowed.verdict, "good");
  EXPECT_LT(*allowed.gates[0].p_corrected, 0.01);
  EXPECT_NEAR(*allowed.gates[0].change, 1.15, 0.03);
}

TEST(Compare, OnlyTheDirectionThatWasAskedForIsARegression) {
  const Results baseline = MadeUpResults{}.make();
  const Results fewer = MadeUpResults{.count_shift = 0.5, .seed = 2}.make();
  auto gates = count_gate(1.3);
  gates[0].direction = Tail::upper;
  EXPECT_EQ(compare_results(baseline, fewer, gates).verdict, "good");
  gates[0].direction = Tail::lower;
  EXPECT_EQ(compare_results(baseline, fewer, gates).verdict, "regression");
  // Faster is no regression either.
  const Results faster = MadeUpResults{.time_shift = 0.4}.make();
  EXPECT_EQ(compare_results(baseline, faster, default_gates()).verdict, "good");
}

TEST(Compare, AGateBelowTheNoiseIsRefusedWithTheOneThatTheDataSupport) {
  const Results baseline = MadeUpResults{}.make();
  const Comparison comparison = compare_results(baseline, baseline, count_gate(1.01));
  EXPECT_EQ(comparison.verdict, "refused");
  EXPECT_EQ(comparison.exit_code, ExitCode::bad_input);
  EXPECT_THAT(comparison.gates[0].reason, HasSubstr("below the noise"));
  const double supported = *comparison.gates[0].noise;
  EXPECT_GT(supported, 1.01);
  EXPECT_EQ(compare_results(baseline, baseline, count_gate(supported)).verdict, "good");

  std::vector<Gate> distance = {
      {.metric = "fragment_volume", .test = GateTest::kolmogorov_smirnov, .limit = 1e-3}};
  EXPECT_EQ(compare_results(baseline, baseline, distance).verdict, "refused");
  distance[0].raise_to_noise = true;
  const Comparison raised = compare_results(baseline, baseline, distance);
  EXPECT_EQ(raised.verdict, "good");
  EXPECT_GT(raised.gates[0].gate.limit, 1e-3);
}

TEST(Compare, RepeatsLetTheNoiseBeThatOfTheMethodAlone) {
  const auto noise = [](std::size_t collisions, int repeats) {
    const Results results = MadeUpResults{.collisions = collisions, .repeats = repeats}.make();
    return *compare_results(results, results, count_gate(2)).gates[0].noise - 1;
  };
  EXPECT_LT(noise(50, 2), 0.6 * noise(100, 1));
}

TEST(Compare, TimesTakeTheirNoiseFromTheRepeatsOfTheBaseline) {
  const Gate gate{.metric = "total_seconds",
                  .test = GateTest::paired_ratio,
                  .direction = Tail::upper,
                  .limit = 1.001,
                  .relative = true};
  // Compared with itself a run has ratios without any scatter.
  const auto itself = [&](int repeats) {
    const Results results = MadeUpResults{.collisions = 40, .repeats = repeats}.make();
    return compare_results(results, results, {gate}).gates.at(0);
  };
  EXPECT_EQ(itself(1).noise.value(), 1.0) << "impacts differ in what they cost";
  const GateResult repeated = itself(2);
  EXPECT_EQ(repeated.outcome, GateOutcome::refused);
  const Results baseline = MadeUpResults{.collisions = 40, .repeats = 2}.make();
  const Results rerun = MadeUpResults{.collisions = 40, .repeats = 2, .rerun = 5}.make();
  const double scatter = compare_results(baseline, rerun, {gate}).gates.at(0).noise.value();
  EXPECT_NEAR(std::log(*repeated.noise) / std::log(scatter), 1, 0.4) << "of the same size";
}

TEST(Compare, AStatusThatBecomesWorseAlwaysIsARegression) {
  const Results baseline = MadeUpResults{}.make();
  for (const CellStatus status : {CellStatus::invalid, CellStatus::unbroken, CellStatus::timeout,
                                  CellStatus::out_of_memory, CellStatus::crash}) {
    Results candidate = baseline;
    candidate.cells[3].status = status;
    candidate.cells[3].reason = "the reason";
    const Comparison worse = compare_results(baseline, candidate, default_gates());
    EXPECT_EQ(worse.exit_code, ExitCode::regression);
    ASSERT_EQ(worse.status_regressions.size(), 1u);
    EXPECT_THAT(worse.status_regressions[0], HasSubstr("bunny/single/0003/cvd: was ok"));
    if (status == CellStatus::unbroken) continue;
    EXPECT_THAT(worse.status_regressions[0], HasSubstr("the reason"));
    const Comparison better = compare_results(candidate, baseline, default_gates());
    EXPECT_EQ(better.exit_code, ExitCode::good) << better.verdict;
    EXPECT_THAT(better.notes, Contains(HasSubstr("no longer fail")));
  }
}

TEST(Compare, CellsThatAreMissingAreNotPassedOver) {
  const Results baseline = MadeUpResults{}.make();
  Results part = baseline;
  part.cells.erase(part.cells.begin() + 5);
  const Comparison missing = compare_results(baseline, part, default_gates());
  EXPECT_EQ(missing.exit_code, ExitCode::not_measured);
  EXPECT_THAT(missing.problems, Contains(HasSubstr("bunny/single/0005/cvd")));
  EXPECT_EQ(compare_results(part, baseline, default_gates()).exit_code, ExitCode::not_measured);
  Results none = baseline;
  none.cells.clear();
  EXPECT_EQ(compare_results(baseline, none, default_gates()).exit_code, ExitCode::not_measured);
  Results damaged = baseline;
  damaged.unreadable = {"x.h5: cut short"};
  EXPECT_EQ(compare_results(baseline, damaged, default_gates()).exit_code, ExitCode::not_measured);
  // A regression among what is there is one, whatever is missing.
  part.cells[0].status = CellStatus::crash;
  EXPECT_EQ(compare_results(baseline, part, default_gates()).exit_code, ExitCode::regression);
}

TEST(Compare, ABaselineThatIsMissingOrOfAnotherSuiteHasItsOwnVerdict) {
  const Results baseline = MadeUpResults{}.make();
  Results other = baseline;
  other.suite.values["seed"] = 2;
  const Comparison unequal = compare_results(baseline, other, default_gates());
  EXPECT_EQ(unequal.verdict, "unequal-suites");
  EXPECT_EQ(unequal.exit_code, ExitCode::baseline_missing);
  EXPECT_THAT(unequal.problems, Contains(HasSubstr("seed: 1 there, 2 here")));
  Results none = baseline;
  none.cells.clear();
  EXPECT_EQ(compare_results(none, baseline, default_gates()).verdict, "no-baseline");
  const Comparison missing = compare_folders("nowhere", "nowhere too", default_gates());
  EXPECT_EQ(missing.verdict, "no-baseline");
  EXPECT_THAT(missing.problems, Contains(HasSubstr("--accept")));
}

TEST(Compare, TimesOfOtherMachinesAreReportedAndNotJudged) {
  const Results baseline = MadeUpResults{}.make();
  const Comparison other = compare_results(
      baseline, MadeUpResults{.time_shift = 9, .cpu = "another"}.make(), default_gates());
  EXPECT_EQ(other.verdict, "good");
  const GateResult& gate = gate_of(other, "total_seconds");
  EXPECT_EQ(gate.outcome, GateOutcome::reported);
  EXPECT_NEAR(*gate.change, 9, 0.5);
  EXPECT_LT(*gate.change_low, *gate.change);
  EXPECT_GT(*gate.change_high, *gate.change);
  Results threads = MadeUpResults{.time_shift = 9}.make();
  for (CellSummary& cell : threads.cells) cell.threads = 8;
  EXPECT_EQ(compare_results(baseline, threads, default_gates()).verdict, "good");
}

TEST(Compare, TimesRelativeToAnotherMethodAreJudgedOnAnyMachine) {
  // Two methods; `machine` is the time that a machine takes for the same work.
  const auto both = [](double own_shift, double machine, std::uint64_t rerun) {
    const std::string cpu = fmt::format("of speed {}", 1 / machine);
    Results results =
        MadeUpResults{.time_shift = own_shift * machine, .rerun = rerun, .cpu = cpu}.make();
    const Results other =
        MadeUpResults{.time_shift = machine, .rerun = rerun + 50, .cpu = cpu}.make();
    for (CellSummary cell : other.cells) {
      cell.label = "other";
      results.cells.push_back(cell);
    }
    return results;
  };
  const Gate gate{.metric = "total_seconds",
                  .test = GateTest::paired_ratio,
                  .relative_to = "other",
                  .direction = Tail::upper,
                  .limit = 1.3,
                  .relative = true};
  const Results baseline = both(1, 1, 1);
  const Comparison same = compare_results(baseline, both(1, 2, 2), {gate});
  ASSERT_EQ(same.gates.size(), 1u) << "not beside itself";
  EXPECT_EQ(same.gates[0].outcome, GateOutcome::pass) << same.gates[0].reason;
  EXPECT_NEAR(same.gates[0].change.value(), 1, 0.1);
  const Comparison slower = compare_results(baseline, both(1.6, 0.5, 3), {gate});
  EXPECT_EQ(slower.gates.at(0).outcome, GateOutcome::regression) << slower.gates[0].reason;
  EXPECT_NEAR(slower.gates[0].change.value(), 1.6, 0.1);
}

TEST(Compare, GatesOnWhatTheBaselineDoesNotHaveAreMistakes) {
  const Results baseline = MadeUpResults{}.make();
  const auto complain = [&](Gate gate) {
    try {
      compare_results(baseline, baseline, {gate});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(complain({.metric = "fragment_cuont", .limit = 1}),
              HasSubstr("did you mean 'fragment_count'"));
  EXPECT_THAT(complain({.metric = "roughness", .method = "cdv", .limit = 1}),
              HasSubstr("did you mean 'cvd'"));
  EXPECT_THAT(complain({.metric = "roughness", .shape = "pott", .limit = 1}),
              HasSubstr("did you mean 'pot'"));
}

TEST(Compare, ImpactsThatDifferAreNoted) {
  const Results baseline = MadeUpResults{}.make();
  Results other = baseline;
  other.cells[0].impulses = {1};
  EXPECT_THAT(compare_results(baseline, other, default_gates()).notes,
              Contains(HasSubstr("1 of 40 cells met other impacts")));
}

}  // namespace
}  // namespace fracbench
