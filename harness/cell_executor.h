#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <stop_token>
#include <string>

#include "core/progress.h"
#include "harness/breakable_cache.h"
#include "harness/plan.h"
#include "harness/record.h"

namespace fracbench {

/// What a cell is at; each has its own limit of time.
enum class CellPhase : std::uint8_t { prepare, warm_up, measure };

/// Measures cells of a plan in this process: prepares the body, runs the scene, measures. From as
/// many threads as one likes. What goes wrong in a method ends up in the record's status.
class CellExecutor {
 public:
  /// `alone`: one cell at a time, so that the process's peak memory is that of the cell.
  /// `phase` is told what a cell is at, each warm-up run anew.
  CellExecutor(const Plan& plan, const Catalog& catalog, bool alone,
               std::function<void(CellPhase)> phase = {});

  /// Throws Cancelled when asked to stop, and InputError where the method refuses its options.
  Record execute(const Cell& cell, Progress& progress, const std::stop_token& stop);

 private:
  void enter(CellPhase phase) const;
  SceneResult run_scene(const Cell& cell, const Prepared& prepared, StageTimer& timer,
                        Progress& progress, const std::stop_token& stop,
                        CellOutcome* outcome) const;
  /// The suite's warm-up runs, where the body was prepared just now.
  void warm_up(const Cell& cell, const Prepared& prepared, StageTimer& timer, Progress& progress,
               const std::stop_token& stop) const;

  const Plan& plan_;
  const Catalog& catalog_;
  bool alone_;
  std::function<void(CellPhase)> phase_;
  BreakableCache cache_;
  std::map<std::string, std::string> provenance_;
};

}  // namespace fracbench
