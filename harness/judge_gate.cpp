#include "harness/judge_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/random.h"
#include "metrics/cluster_bootstrap.h"
#include "metrics/clustered_distance.h"
#include "metrics/rerun_noise.h"
#include "metrics/summary.h"

namespace fracbench {

namespace {

// Shorter times are those of the clock and of the scheduler.
constexpr double kShortestTime = 1e-3;

// Enough for the 1 % that exceed the noise, and affordable for 100,000 collisions.
constexpr std::size_t kNoiseDraws = 399;

std::optional<double> value_of(const CellSummary& cell, const std::string& metric) {
  if (metric == "total_seconds") return cell.total_seconds;
  if (metric == "peak_memory") return cell.peak_memory;
  if (metric.starts_with("stage_")) {
    for (const StageTime& stage : cell.stages) {
      if (metric.substr(6) == stage.name) return stage.seconds;
    }
    return std::nullopt;
  }
  for (const MetricValue& value : cell.values) {
    if (value.name == metric) return value.value;
  }
  return std::nullopt;
}

// Where there are more collisions than this, as many swaps are drawn as the significance needs: a
// change that matters is then far from its limit, and 10,000 collisions take 7 s, not 19.
constexpr std::size_t kMany = 2000;

/// A single value is a series of one.
std::vector<double> series_of(const CellSummary& cell, const std::string& metric) {
  for (const MetricSeries& series : cell.series) {
    if (series.name == metric) return series.values;
  }
  const auto value = value_of(cell, metric);
  return value ? std::vector<double>{*value} : std::vector<double>{};
}

/// Collisions that are alike, see metrics/rerun_noise.h.
struct Alike {
  std::vector<std::size_t> groups;  ///< parallel to the pairs
  bool repeats = false;             ///< they are repeats of one impact, not impacts on one shape
};

Alike alike_of(const std::vector<CellPair>& pairs) {
  std::map<std::string, std::vector<std::size_t>> impacts;
  std::map<std::string, std::vector<std::size_t>> shapes;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const CellSummary& cell = *pairs[i].baseline;
    const std::string shape = cell.shape + "/" + cell.family;
    impacts[shape + "/" + cell.scenario].push_back(i);
    shapes[shape].push_back(i);
  }
  Alike alike{.groups = std::vector<std::size_t>(pairs.size())};
  alike.repeats =
      std::ranges::all_of(impacts, [](const auto& impact) { return impact.second.size() > 1; });
  std::size_t number = 0;
  for (const auto& [name, members] : alike.repeats ? impacts : shapes) {
    for (const std::size_t i : members) alike.groups[i] = number;
    ++number;
  }
  return alike;
}

bool comparable_machines(const std::vector<CellPair>& pairs) {
  std::set<std::pair<std::string, int>> machines;
  for (const CellPair& pair : pairs) {
    machines.emplace(pair.baseline->cpu, pair.baseline->threads);
    machines.emplace(pair.candidate->cpu, pair.candidate->threads);
  }
  return machines.size() == 1 && !machines.begin()->first.empty();
}

/// What all three kinds of gate have in common while one is measured.
class Measuring {
 public:
  Measuring(GateResult& result, std::size_t tests, std::size_t pairs)
      : result_(result),
        random_(derive_seed(1, {result.gate.metric, result.method, result.gate.shape,
                                to_string(result.gate.test)})),
        single_significance_(result.gate.significance / static_cast<double>(tests)) {
    if (pairs > kMany) options_.draws = 1999;
    options_.draws = std::max(options_.draws, static_cast<std::size_t>(3 / single_significance_));
  }

  void mean(const std::vector<CellPair>& pairs);
  void distance(const std::vector<CellPair>& pairs);
  /// `others` are parallel to `pairs`, or none: the cells that times are relative to.
  void ratio(const std::vector<CellPair>& pairs, const std::vector<CellPair>& others);

 private:
  Gate& gate() { return result_.gate; }
  Tail tail() const {
    const bool two_sided = result_.gate.test == GateTest::kolmogorov_smirnov ||
                           result_.gate.test == GateTest::wasserstein;
    return two_sided ? Tail::both : result_.gate.direction;
  }
  void end(GateOutcome outcome, std::string reason) {
    result_.outcome = outcome;
    result_.reason = std::move(reason);
  }

  /// False where the gate cannot be judged with this many collisions.
  bool enough(std::size_t collisions, bool identical);
  /// False where the limit is below the noise and may not be raised.
  bool above_noise();

  GateResult& result_;
  Random random_;
  double single_significance_;  ///< of one gate, where Holm's correction is strictest
  PermutationOptions options_;
};

bool Measuring::enough(std::size_t collisions, bool identical) {
  result_.collisions = collisions;
  const GateOutcome too_few = gate().optional ? GateOutcome::reported : GateOutcome::not_measured;
  if (collisions == 0) {
    end(too_few,
        gate().of_machine()
            ? fmt::format("'{}' is never above {} s in both runs", gate().metric, kShortestTime)
            : fmt::format("no collision that both runs broke has '{}'", gate().metric));
    return false;
  }
  if (identical || smallest_p(collisions, tail()) <= single_significance_) return true;
  std::size_t needed = collisions;
  while (smallest_p(needed, tail()) > single_significance_) ++needed;
  end(too_few,
      fmt::format("{} collisions cannot show a significant change; {} can", collisions, needed));
  return false;
}

bool Measuring::above_noise() {
  if (!result_.noise || *result_.noise <= gate().limit) return true;
  if (gate().raise_to_noise) {
    gate().limit = *result_.noise;
    return true;
  }
  end(GateOutcome::refused,
      fmt::format("the limit {:.4g} is below the noise of these data; the smallest that they "
                  "support is {:.4g}: raise it, or measure more collisions",
                  gate().limit, *result_.noise));
  return false;
}

void Measuring::mean(const std::vector<CellPair>& pairs) {
  std::vector<double> before;
  std::vector<double> after;
  std::vector<double> differences;
  std::vector<CellPair> used;
  for (const CellPair& pair : pairs) {
    const auto b = value_of(*pair.baseline, gate().metric);
    const auto c = value_of(*pair.candidate, gate().metric);
    if (!b || !c) continue;
    before.push_back(*b);
    after.push_back(*c);
    differences.push_back(*c - *b);
    used.push_back(pair);
  }
  const bool identical = before == after;
  const bool judged = enough(before.size(), identical);
  if (before.empty()) return;
  const double mean = summarize(before).mean;
  result_.baseline = mean;
  result_.candidate = summarize(after).mean;
  if (gate().relative && mean <= 0) {
    if (identical) return;
    return end(GateOutcome::refused,
               fmt::format("a factor needs a mean above 0, and the baseline's is {:.4g}; give "
                           "'change' instead of 'factor'",
                           mean));
  }
  result_.change = gate().relative ? *result_.candidate / mean : summarize(differences).mean;
  if (!judged) return;

  const double error = mean_difference_error(before, alike_of(used).groups);
  const std::size_t n = used.size();
  const double chance = shift_by_chance(error, n, gate().significance, tail());
  if (!gate().relative) {
    result_.noise = chance;
  } else if (tail() == Tail::upper) {
    result_.noise = 1 + chance / mean;
  } else if (chance < mean) {
    result_.noise = mean / (mean - chance);
  } else {
    return end(gate().raise_to_noise ? GateOutcome::not_measured : GateOutcome::refused,
               fmt::format("{} collisions support no factor at all; measure more", n));
  }
  if (!above_noise()) return;
  const bool lower = gate().relative && tail() == Tail::lower;
  const double threshold = !gate().relative ? gate().limit
                           : lower          ? mean * (1 - 1 / gate().limit)
                                            : mean * (gate().limit - 1);
  const double shift = detectable_shift(error, n, single_significance_, threshold, tail());
  if (!gate().relative) {
    result_.detectable = shift;
  } else if (!lower) {
    result_.detectable = 1 + shift / mean;
  } else if (shift < mean) {
    result_.detectable = mean / (mean - shift);
  }
  result_.p = sign_flip_test(differences, tail(), options_, random_).p;
}

void Measuring::distance(const std::vector<CellPair>& pairs) {
  Clusters before;
  Clusters after;
  for (const CellPair& pair : pairs) {
    before.push_back(series_of(*pair.baseline, gate().metric));
    after.push_back(series_of(*pair.candidate, gate().metric));
  }
  const Distance kind =
      gate().test == GateTest::wasserstein ? Distance::wasserstein : Distance::kolmogorov_smirnov;
  const ClusteredDistance distance(before, after, kind);
  const bool judged = enough(distance.exists() ? pairs.size() : 0, before == after);
  if (!distance.exists()) return;
  result_.change = distance.observed();
  if (!judged) return;

  const std::vector<double> chance =
      distances_by_chance(before, alike_of(pairs).groups, kind, kNoiseDraws, random_);
  const double strict = quantile(chance, 1 - single_significance_).value_or(0);
  result_.noise = quantile(chance, 1 - gate().significance).value_or(0);
  if (!above_noise()) return;
  // Where the runs differ, the distance scatters by the error of a single share (Kolmogorov and
  // Smirnov) or of a mean (Wasserstein); these are at most 0.58 and 1.25 times the mean distance of
  // no difference, and 95 % are within 1.64 of them.
  const double scatter = kind == Distance::kolmogorov_smirnov ? 1.0 : 2.1;
  result_.detectable = std::max(gate().limit, strict) + scatter * summarize(chance).mean;
  result_.p = distance_test(distance, options_, random_).p;
}

void Measuring::ratio(const std::vector<CellPair>& pairs, const std::vector<CellPair>& others) {
  const double shortest = gate().metric == "peak_memory" ? 0 : kShortestTime;
  const auto log_of = [&](const CellSummary& cell) -> std::optional<double> {
    const auto value = value_of(cell, gate().metric);
    if (!value || *value <= shortest) return std::nullopt;
    return std::log(*value);
  };
  std::vector<double> before;  // logarithms in the baseline, of ratios where there are others
  std::vector<double> logs;    // of candidate / baseline
  std::vector<CellPair> used;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    auto b = log_of(*pairs[i].baseline);
    auto c = log_of(*pairs[i].candidate);
    if (b && c && !others.empty()) {
      const auto b_other = log_of(*others[i].baseline);
      const auto c_other = log_of(*others[i].candidate);
      b = b_other ? std::optional(*b - *b_other) : std::nullopt;
      c = c_other ? std::optional(*c - *c_other) : std::nullopt;
    }
    if (!b || !c) continue;
    before.push_back(*b);
    logs.push_back(*c - *b);
    used.push_back(pairs[i]);
  }
  const bool identical = std::ranges::all_of(logs, [](double log) { return log == 0; });
  const bool judged = enough(logs.size(), identical);
  if (logs.empty()) return;
  const Summary summary = summarize(logs);
  result_.change = std::exp(summary.mean);
  const auto interval = cluster_bootstrap(
      logs.size(),
      [&](std::span<const std::size_t> chosen) -> std::optional<double> {
        double total = 0;
        for (const std::size_t i : chosen) total += logs[i];
        return total / static_cast<double>(chosen.size());
      },
      {}, random_);
  if (interval) {
    result_.change_low = std::exp(interval->low);
    result_.change_high = std::exp(interval->high);
  }
  if (others.empty() && !comparable_machines(pairs)) {
    return end(GateOutcome::reported,
               "not judged: not all were measured on the same processor with the same threads");
  }
  if (!judged) return;
  // Impacts differ in what they cost, so only repeats of one tell how a time varies by itself.
  // Where the baseline has them, a candidate that happens to scatter little does not make it less
  // noisy.
  double error = summary.deviation() / std::sqrt(static_cast<double>(logs.size()));
  if (const Alike alike = alike_of(used); alike.repeats) {
    error = std::max(error, mean_difference_error(before, alike.groups));
  }
  const std::size_t n = logs.size();
  result_.noise = std::exp(shift_by_chance(error, n, gate().significance, tail()));
  if (!above_noise()) return;
  result_.detectable =
      std::exp(detectable_shift(error, n, single_significance_, std::log(gate().limit), tail()));
  result_.p = sign_flip_test(logs, tail(), options_, random_).p;
}

bool exceeds(const GateResult& result) {
  const Gate& gate = result.gate;
  const double change = *result.change;
  const double low = gate.relative ? 1 / gate.limit : -gate.limit;
  return (gate.direction != Tail::lower && change > gate.limit) ||
         (gate.direction != Tail::upper && change < low);
}

/// Leaves only those of `used` for which `label` broke the same collision, too; returns its cells.
std::vector<CellPair> keep_those_of(const std::string& label, const std::vector<CellPair>& pairs,
                                    std::vector<CellPair>& used) {
  std::map<Collision, CellPair> of_label;
  for (const CellPair& pair : pairs) {
    if (pair.baseline->label == label && pair.baseline->status == CellStatus::ok &&
        pair.candidate->status == CellStatus::ok) {
      of_label.emplace(collision_of(*pair.baseline), pair);
    }
  }
  std::erase_if(
      used, [&](const CellPair& pair) { return !of_label.contains(collision_of(*pair.baseline)); });
  std::vector<CellPair> others;
  for (const CellPair& pair : used) others.push_back(of_label.at(collision_of(*pair.baseline)));
  return others;
}

}  // namespace

GateResult measure_gate(const Gate& gate, const std::string& method,
                        const std::vector<CellPair>& pairs, std::size_t tests) {
  GateResult result{.gate = gate, .method = method};
  std::vector<CellPair> used;
  for (const CellPair& pair : pairs) {
    if (pair.baseline->label == method &&
        (gate.shape.empty() || pair.baseline->shape == gate.shape) &&
        pair.baseline->status == CellStatus::ok && pair.candidate->status == CellStatus::ok) {
      used.push_back(pair);
    }
  }
  const bool absent = std::ranges::all_of(
      used, [&](const CellPair& pair) { return series_of(*pair.baseline, gate.metric).empty(); });
  if (gate.built_in && absent && !used.empty()) {
    result.outcome = GateOutcome::reported;
    result.reason = fmt::format("the baseline has no '{}'", gate.metric);
    return result;
  }
  Measuring measuring(result, tests, used.size());
  if (gate.test == GateTest::mean) {
    measuring.mean(used);
  } else if (gate.test == GateTest::paired_ratio) {
    std::vector<CellPair> others;
    if (!gate.relative_to.empty()) others = keep_those_of(gate.relative_to, pairs, used);
    measuring.ratio(used, others);
  } else {
    measuring.distance(used);
  }
  return result;
}

void decide(std::vector<GateResult>& results) {
  std::vector<double> p;
  for (const GateResult& result : results) {
    if (result.p) p.push_back(*result.p);
  }
  const std::vector<double> corrected = holm(p);
  std::size_t next = 0;
  for (GateResult& result : results) {
    if (!result.p) continue;
    result.p_corrected = corrected[next++];
    const bool large = exceeds(result);
    const bool significant = *result.p_corrected <= result.gate.significance;
    if (large && significant) result.outcome = GateOutcome::regression;
    result.reason = large && significant ? "larger than the limit, and significant"
                    : large              ? "larger than the limit, but not significant"
                    : significant        ? "significant, but within the limit"
                                         : "within the limit, and not significant";
  }
}

}  // namespace fracbench
