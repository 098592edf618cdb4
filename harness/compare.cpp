#include "harness/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "harness/judge_gate.h"
#include "harness/label_agreement.h"
#include "harness/summary_file.h"

namespace fracbench {

namespace {

constexpr std::string_view kEveryStage = "stage_*";
constexpr std::size_t kShown = 20;

std::vector<std::string> metric_names(const Results& results) {
  std::set<std::string> names = {"total_seconds", "peak_memory", std::string(kEveryStage)};
  for (const CellSummary& cell : results.cells) {
    for (const MetricValue& value : cell.values) names.insert(value.name);
    for (const MetricSeries& series : cell.series) names.insert(series.name);
    for (const StageTime& stage : cell.stages) names.insert("stage_" + stage.name);
  }
  return {names.begin(), names.end()};
}

void require_known(const std::string& word, const std::vector<std::string>& known,
                   std::string_view what) {
  if (word.empty() || std::ranges::find(known, word) != known.end()) return;
  throw InputError(
      fmt::format("gate: the baseline has no {} '{}'{}", what, word, did_you_mean(word, known)));
}

/// The reference does not agree with itself.
bool has_value(const Results& results, const std::string& label, const std::string& metric) {
  return std::ranges::any_of(results.cells, [&](const CellSummary& cell) {
    return cell.label == label &&
           std::ranges::find(cell.values, metric, &MetricValue::name) != cell.values.end();
  });
}

/// One gate for each method, and for each stage where it is about all of them.
std::vector<std::pair<Gate, std::string>> expand(const std::vector<Gate>& gates,
                                                 const Results& baseline) {
  std::vector<std::string> labels;
  std::set<std::string> shapes;
  std::map<std::string, std::set<std::string>> stages;
  for (const CellSummary& cell : baseline.cells) {
    if (std::ranges::find(labels, cell.label) == labels.end()) labels.push_back(cell.label);
    shapes.insert(cell.shape);
    for (const StageTime& stage : cell.stages) stages[cell.label].insert(stage.name);
  }
  const std::vector<std::string> metrics = metric_names(baseline);
  std::vector<std::pair<Gate, std::string>> expanded;
  for (const Gate& gate : gates) {
    if (!gate.built_in) require_known(gate.metric, metrics, "metric");
    require_known(gate.method, labels, "method");
    require_known(gate.relative_to, labels, "method");
    require_known(gate.shape, {shapes.begin(), shapes.end()}, "shape");
    for (const std::string& label : labels) {
      if (!gate.method.empty() && gate.method != label) continue;
      if (gate.relative_to == label) continue;
      if (gate.metric == kLabelAgreement && !has_value(baseline, label, gate.metric)) continue;
      if (gate.metric != kEveryStage) {
        expanded.emplace_back(gate, label);
        continue;
      }
      for (const std::string& stage : stages[label]) {
        Gate one = gate;
        one.metric = "stage_" + stage;
        one.optional = true;  // some stages are rare or short in every suite
        expanded.emplace_back(one, label);
      }
    }
  }
  return expanded;
}

void list_cells(const std::vector<std::string>& cells, std::string_view what,
                std::vector<std::string>& lines) {
  if (cells.empty()) return;
  std::string line = fmt::format("{} {}:", cells.size(), what);
  for (std::size_t i = 0; i < std::min(kShown, cells.size()); ++i) {
    line += (i == 0 ? " " : ", ") + cells[i];
  }
  if (cells.size() > kShown) line += fmt::format(" and {} more", cells.size() - kShown);
  lines.push_back(std::move(line));
}

void describe_cells(const CellPairs& cells, const Results& baseline, const Results& candidate,
                    Comparison& comparison) {
  for (const Results* results : {&baseline, &candidate}) {
    for (const std::string& message : results->unreadable) {
      comparison.problems.push_back("cannot be read: " + message);
    }
  }
  list_cells(cells.missing, "cells of the baseline are missing in the candidate",
             comparison.problems);
  list_cells(cells.added, "cells of the candidate have no baseline", comparison.problems);
  list_cells(cells.repairs, "cells no longer fail", comparison.notes);
  list_cells(cells.still_failing, "cells fail in both", comparison.notes);
  comparison.status_regressions = cells.regressions;
  if (baseline.suite.cells > baseline.cells.size()) {
    comparison.notes.push_back(fmt::format("the baseline has {} of the suite's {} cells",
                                           baseline.cells.size(), baseline.suite.cells));
  }
  if (cells.other_impacts > 0) {
    comparison.notes.push_back(
        fmt::format("{} of {} cells met other impacts than in the baseline: the scene has changed, "
                    "or the processor is of another kind",
                    cells.other_impacts, cells.pairs.size()));
  }
}

void conclude(Comparison& comparison) {
  const auto any = [&](GateOutcome outcome) {
    return std::ranges::any_of(comparison.gates,
                               [&](const GateResult& gate) { return gate.outcome == outcome; });
  };
  if (!comparison.status_regressions.empty() || any(GateOutcome::regression)) {
    comparison.verdict = "regression";
    comparison.exit_code = ExitCode::regression;
  } else if (any(GateOutcome::refused)) {
    comparison.verdict = "refused";
    comparison.exit_code = ExitCode::bad_input;
  } else if (!comparison.problems.empty() || any(GateOutcome::not_measured) ||
             comparison.compared == 0) {
    comparison.verdict = "not-measured";
    comparison.exit_code = ExitCode::not_measured;
  } else {
    comparison.verdict = "good";
  }
}

Comparison not_comparable(std::string verdict, std::vector<std::string> problems) {
  Comparison comparison;
  comparison.verdict = std::move(verdict);
  comparison.exit_code = ExitCode::baseline_missing;
  comparison.problems = std::move(problems);
  return comparison;
}

}  // namespace

std::string_view to_string(GateOutcome outcome) {
  switch (outcome) {
    case GateOutcome::pass:
      return "pass";
    case GateOutcome::regression:
      return "regression";
    case GateOutcome::refused:
      return "refused";
    case GateOutcome::not_measured:
      return "not-measured";
    case GateOutcome::reported:
      return "reported";
  }
  return "";
}

Comparison compare_results(const Results& baseline, const Results& candidate,
                           const std::vector<Gate>& gates) {
  if (baseline.cells.empty()) {
    return not_comparable("no-baseline",
                          {"the baseline holds no records; measure it, or accept one with --accept "
                           "--why TEXT"});
  }
  std::vector<std::string> differences = differing_values(baseline.suite, candidate.suite.values);
  if (!differences.empty()) {
    differences.insert(differences.begin(),
                       "the baseline (there) and the candidate (here) belong to different suites, "
                       "or to other values of one");
    return not_comparable("unequal-suites", std::move(differences));
  }
  Comparison comparison;
  comparison.suite = baseline.suite.name;
  const CellPairs cells = match_cells(baseline, candidate);
  comparison.compared = cells.pairs.size();
  describe_cells(cells, baseline, candidate, comparison);
  const auto expanded = expand(gates, baseline);
  for (const auto& [gate, method] : expanded) {
    comparison.gates.push_back(measure_gate(gate, method, cells.pairs, expanded.size()));
  }
  decide(comparison.gates);
  conclude(comparison);
  return comparison;
}

Comparison compare_folders(const std::filesystem::path& baseline,
                           const std::filesystem::path& candidate, const std::vector<Gate>& gates) {
  const bool summary = names_summary_file(baseline);
  if (!std::filesystem::exists(summary ? baseline : baseline / "suite.json")) {
    return not_comparable("no-baseline",
                          {fmt::format("{}: there is no baseline; make the candidate the first one "
                                       "with fracbench compare {} {} --accept --why TEXT",
                                       baseline.string(), baseline.string(), candidate.string())});
  }
  // What has to be computed from meshes is read only where it is asked for.
  const bool agreement =
      std::ranges::any_of(gates, [](const Gate& gate) { return gate.metric == kLabelAgreement; });
  const auto read = [&](const std::filesystem::path& folder) {
    Results results = read_results(folder);
    if (agreement) add_label_agreement(folder, results);
    return results;
  };
  return compare_results(summary ? read_summary_file(baseline).results : read(baseline),
                         read(candidate), gates);
}

}  // namespace fracbench
