#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "harness/catalog.h"
#include "harness/plan.h"
#include "harness/record.h"
#include "harness/run_result.h"

namespace fracbench {

/// How far a run has come.
struct RunProgress {
  std::size_t cells = 0;
  std::size_t done = 0;                ///< records that are there, new or found
  std::size_t found = 0;               ///< of them: were there before
  std::size_t failed = 0;              ///< of them: neither ok nor unbroken
  std::size_t unbroken = 0;            ///< of them: the target stayed whole
  double seconds = 0;                  ///< since the start
  std::optional<double> seconds_left;  ///< once a cell of each kind has been measured
  std::vector<std::string> running;    ///< "pot single-3 cvd: cut 40 %"
};

/// Measures one cell; see CellExecutor::execute. Called from many threads.
using ExecuteCell =
    std::function<Record(const Cell& cell, Progress& progress, const std::stop_token& stop)>;

struct RunOptions {
  std::filesystem::path folder;  ///< of the results
  std::string command = {};      ///< that a user gave; kept in a new folder, for its reports
  int jobs = 1;                  ///< cells at a time
  std::stop_token stop = {};     ///< asked to stop: cells under way are given up
  /// Both are called from the thread that called run_suite; progress some times a second.
  std::function<void(const RunProgress&)> progress = {};
  std::function<void(std::string_view)> message = {};
  /// How a cell is measured; by default in this process.
  ExecuteCell execute = {};
  /// Whether a cell can be measured without something being prepared for it a second time. Among
  /// the cells that come next, such ones go first.
  std::function<bool(const Cell&)> ready = {};
  /// The times shall count: whether the machine is idle is looked at before the first cell, said
  /// where it is not, and written down.
  bool timed = false;
};

/// Measures the cells of a plan whose records are not in the results folder yet. May be killed at
/// any moment and called again; may be at work on one folder in many processes at a time.
/// Records that are damaged, or that were made by other sources, are set aside and redone.
/// Throws InputError for a folder that cannot be used and for a disk that is full.
RunResult run_suite(const Plan& plan, const Catalog& catalog, const RunOptions& options);

}  // namespace fracbench
