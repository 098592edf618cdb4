#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/cell_pairs.h"
#include "harness/exit_code.h"
#include "harness/gates.h"

namespace fracbench {

enum class GateOutcome : std::uint8_t {
  pass,
  regression,
  refused,       ///< asks for more than the data can tell from noise
  not_measured,  ///< too few or no collisions to judge
  reported,      ///< not judged: times of different machines, stages that are too short
};

/// "pass", "regression", "refused", "not-measured" or "reported".
std::string_view to_string(GateOutcome outcome);

/// What one gate says of one method. A change is a ratio where the gate is relative, else a
/// difference or a distance, in the metric's unit; what does not exist is none.
struct GateResult {
  Gate gate;           ///< with one metric and one method; its limit is the one that was used
  std::string method;  ///< label in the suite
  GateOutcome outcome = GateOutcome::pass;
  std::string reason = {};     ///< in words, for whoever reads the verdict
  std::size_t collisions = 0;  ///< compared, each as a whole
  std::optional<double> baseline = {};
  std::optional<double> candidate = {};
  std::optional<double> change = {};
  std::optional<double> change_low = {};  ///< 95 % interval, of ratios of times
  std::optional<double> change_high = {};
  std::optional<double> noise =
      {};  ///< what chance makes of no change: the smallest limit supported
  std::optional<double> detectable = {};   ///< smallest change that is found with 95 %
  std::optional<double> p = {};            ///< of this gate by itself
  std::optional<double> p_corrected = {};  ///< by Holm, for all gates that were judged
};

/// Two results folders of one suite, compared.
struct Comparison {
  std::string verdict;  ///< good, regression, refused, not-measured, no-baseline, unequal-suites
  ExitCode exit_code = ExitCode::good;
  std::string suite;
  std::size_t compared = 0;           ///< cells that both have
  std::vector<std::string> problems;  ///< why nothing could be compared, or not everything
  std::vector<std::string> status_regressions;
  std::vector<std::string> notes;  ///< worth knowing, but no reason to fail
  std::vector<GateResult> gates;
};

/// Judges results that belong to one suite. Deterministic. Throws InputError for gates on metrics,
/// methods or shapes that the baseline does not have.
Comparison compare_results(const Results& baseline, const Results& candidate,
                           const std::vector<Gate>& gates);

/// Reads both first, the baseline from a results folder or a summary file; a baseline that is
/// missing or belongs to another suite is a verdict. Throws InputError where the candidate is no
/// results folder.
Comparison compare_folders(const std::filesystem::path& baseline,
                           const std::filesystem::path& candidate, const std::vector<Gate>& gates);

}  // namespace fracbench
