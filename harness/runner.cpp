#include "harness/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <thread>
#include <tuple>

#include "core/error.h"
#include "harness/cell_executor.h"
#include "harness/cost_model.h"
#include "harness/machine_load.h"
#include "harness/record_store.h"
#include "harness/summary_cache.h"
#include "harness/workers/limits_met.h"

namespace fracbench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kProgressInterval = std::chrono::milliseconds(200);
constexpr auto kClaimInterval = std::chrono::milliseconds(100);
constexpr auto kLoadInterval = std::chrono::milliseconds(250);

/// How many cells of the queue may be overtaken by one that is ready.
constexpr std::size_t kAhead = 64;

/// How many lost cells a run tells of.
constexpr std::size_t kLostShown = 10;

/// Whether a cell said nothing about fracture because of its method's program.
bool is_lost(CellStatus status) {
  return status == CellStatus::timeout || status == CellStatus::out_of_memory ||
         status == CellStatus::crash;
}

std::string describe(const Plan& plan, const Cell& cell) {
  const PlannedShape& shape = plan.shapes[cell.shape];
  std::string text = fmt::format("{} {} {}", shape.label, shape.scenarios[cell.scenario].name,
                                 plan.methods[cell.method].label);
  if (plan.suite.repeats > 1) text += fmt::format(" #{}", cell.repeat + 1);
  return text;
}

/// One run: the queue of cells, the threads that empty it, and what is known of them.
class Run {
 public:
  Run(const Plan& plan, const RunOptions& options, const RecordStore& store,
      SummaryCache& summaries, ExecuteCell execute)
      : plan_(plan),
        options_(options),
        store_(store),
        summaries_(summaries),
        execute_(std::move(execute)) {
    for (std::size_t i = 0; i < plan.cells.size(); ++i) {
      queue_.push_back(i);
      ++remaining_[kind_of(plan.cells[i])];
    }
    progress_.cells = result_.cells = plan.cells.size();
  }

  RunResult finish() {
    const std::stop_callback forward(options_.stop, [this] { stop_.request_stop(); });
    {
      alive_ = options_.jobs;  // before the first of them can end
      std::vector<std::jthread> threads;
      for (int j = 0; j < options_.jobs; ++j) threads.emplace_back([this] { work(); });
      report_until_done();
    }
    if (error_) std::rethrow_exception(error_);
    result_.stopped = options_.stop.stop_requested() && !result_.complete();
    return result_;
  }

 private:
  /// Which other cells take as long.
  using Kind = std::pair<std::string, std::string>;

  /// Shows on the progress line what a method says of itself.
  class CellProgress : public Progress {
   public:
    CellProgress(Run& run, std::size_t cell) : run_(run), cell_(cell) { show(""); }
    ~CellProgress() override {
      const std::scoped_lock lock(run_.mutex_);
      run_.running_.erase(cell_);
    }
    void update(std::string_view what, double fraction) override {
      show(fmt::format(": {} {:.0f} %", what, 100 * fraction));
    }

   private:
    void show(std::string_view detail) {
      std::string text = describe(run_.plan_, run_.plan_.cells[cell_]) + std::string(detail);
      const std::scoped_lock lock(run_.mutex_);
      run_.running_[cell_] = std::move(text);
    }
    Run& run_;
    std::size_t cell_;
  };

  Kind kind_of(const Cell& cell) const {
    return {plan_.shapes[cell.shape].label, plan_.methods[cell.method].label};
  }

  void work() {
    try {
      std::size_t busy = 0;  // cells in a row that others are working on
      while (const auto cell = next_cell()) {
        if (do_cell(*cell)) {
          busy = 0;
          continue;
        }
        if (++busy < put_back(*cell)) continue;
        wait_a_little();
        busy = 0;
      }
    } catch (const Cancelled&) {
      stop_.request_stop();
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!error_) error_ = std::current_exception();
      stop_.request_stop();
    }
    const std::scoped_lock lock(mutex_);
    --alive_;
    changed_.notify_all();
  }

  void wait_a_little() {
    const auto end = Clock::now() + kClaimInterval;
    while (Clock::now() < end && !stop_.stop_requested()) {
      std::this_thread::sleep_for(kClaimInterval / 10);
    }
  }

  /// Returns how many cells wait now.
  std::size_t put_back(std::size_t cell) {
    const std::scoped_lock lock(mutex_);
    queue_.push_back(cell);
    return queue_.size();
  }

  std::optional<std::size_t> next_cell() {
    const std::scoped_lock lock(mutex_);
    if (queue_.empty() || stop_.stop_requested()) return std::nullopt;
    auto next = queue_.begin();
    if (options_.ready) {
      const auto end =
          queue_.begin() + static_cast<std::ptrdiff_t>(std::min(kAhead, queue_.size()));
      next = std::find_if(queue_.begin(), end,
                          [&](std::size_t cell) { return options_.ready(plan_.cells[cell]); });
      if (next == end) next = queue_.begin();
    }
    const std::size_t cell = *next;
    queue_.erase(next);
    return cell;
  }

  /// False: somebody else is at it.
  bool do_cell(std::size_t index) {
    const Cell& cell = plan_.cells[index];
    if (take_found(cell, nullptr)) return true;
    const auto claim = store_.claim(cell.key);
    if (!claim) return false;
    // It may have been made, or found to be damaged, by whoever held the claim before.
    if (take_found(cell, &*claim)) return true;
    const auto start = Clock::now();
    const Record record = execute(cell, index);
    summaries_.add(store_.record_file(cell.key), store_.write(*claim, record));
    const std::chrono::duration<double> seconds = Clock::now() - start;
    note(cell, record.outcome.status, seconds.count(), record.cost.stages, false);
    if (is_lost(record.outcome.status)) say_lost(cell, record.outcome);
    return true;
  }

  /// A mistake that all cells share shows with the first, and does not fill the screen.
  void say_lost(const Cell& cell, const CellOutcome& outcome) {
    const std::size_t number = ++lost_;
    if (number > kLostShown) return;
    say(fmt::format("{}: {}: {}{}", describe(plan_, cell), to_string(outcome.status),
                    outcome.reason,
                    number == kLostShown ? "; the records tell of further ones" : ""));
  }

  Record execute(const Cell& cell, std::size_t index) {
    if (options_.timed) std::call_once(load_measured_, [this] { look_at_machine(); });
    CellProgress progress(*this, index);
    Record record = execute_(cell, progress, stop_.get_token());
    record.cost.provenance["jobs"] = std::to_string(options_.jobs);
    if (options_.timed) {
      record.cost.provenance["busy_processors_before_run"] = fmt::format("{:.2f}", load_.busy);
    }
    return record;
  }

  void look_at_machine() {
    load_ = measure_load(kLoadInterval);
    if (load_.idle()) return;
    say(
        fmt::format("this machine is not idle ({}): times of this run say little, which their "
                    "records tell",
                    load_.describe()));
  }

  /// Whether a good record of the cell is there. With the claim, a bad one is set aside.
  bool take_found(const Cell& cell, const Claim* claim) {
    if (!store_.contains(cell.key)) return false;
    std::string damage;
    std::string_view why = "damaged";
    try {
      const CellSummary found = summaries_.read(store_.record_file(cell.key));
      if (!is_lost(found.status) ||
          !may_do_better(store_.read(cell.key), plan_.methods[cell.method].limits)) {
        note(cell, found.status, found.total_seconds, found.stages, true);
        return true;
      }
      why = "outdated";
      damage = fmt::format("tells of a limit that is higher now ({})", found.reason);
    } catch (const DataError& error) {
      damage = error.what();
    }
    if (!claim) return false;
    const auto aside = store_.set_aside(*claim, cell.key, why);
    say(fmt::format("{} ({}) {}; set aside as {} and measured again",
                    store_.record_file(cell.key).string(), describe(plan_, cell), damage,
                    aside.filename().string()));
    return false;
  }

  void note(const Cell& cell, CellStatus status, double seconds, std::span<const StageTime> stages,
            bool found) {
    const Kind kind = kind_of(cell);
    const std::scoped_lock lock(mutex_);
    ++result_.counts[status];
    result_.found += found;
    --remaining_[kind];
    costs_.add(kind.first, kind.second, seconds, stages);
    changed_.notify_all();
  }

  void say(std::string text) {
    const std::scoped_lock lock(mutex_);
    messages_.push_back(std::move(text));
    changed_.notify_all();
  }

  /// Passes on messages and progress until the last thread is done.
  void report_until_done() {
    std::unique_lock lock(mutex_);
    bool last = false;
    while (!last) {
      if (alive_ > 0 && messages_.empty()) changed_.wait_for(lock, kProgressInterval);
      last = alive_ == 0;
      std::vector<std::string> messages;
      messages.swap(messages_);
      const RunProgress progress = current_progress();
      lock.unlock();
      for (const std::string& text : messages) {
        if (options_.message) options_.message(text);
      }
      if (options_.progress) options_.progress(progress);
      lock.lock();
    }
  }

  RunProgress current_progress() const {
    RunProgress progress = progress_;
    progress.done = result_.recorded();
    progress.found = result_.found;
    progress.failed = progress.done - result_.measured();
    progress.unbroken = result_.count(CellStatus::unbroken);
    progress.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    for (const auto& [cell, text] : running_) progress.running.push_back(text);
    double left = 0;
    for (const auto& [kind, count] : remaining_) {
      if (count == 0) continue;
      const auto seconds = costs_.seconds(kind.first, kind.second, count);
      if (!seconds) return progress;
      left += *seconds / options_.jobs;
    }
    progress.seconds_left = left;
    return progress;
  }

  const Plan& plan_;
  const RunOptions& options_;
  const RecordStore& store_;
  SummaryCache& summaries_;
  const ExecuteCell execute_;
  const Clock::time_point start_ = Clock::now();
  std::stop_source stop_;
  std::once_flag load_measured_;
  std::atomic<std::size_t> lost_ = 0;
  MachineLoad load_;  // written once, before the first cell

  std::mutex mutex_;  // guards all that follows
  std::condition_variable changed_;
  std::deque<std::size_t> queue_;
  std::map<Kind, std::size_t> remaining_;
  std::map<std::size_t, std::string> running_;
  std::vector<std::string> messages_;
  CostModel costs_;
  RunProgress progress_;
  RunResult result_;
  std::exception_ptr error_;
  int alive_ = 0;
};

/// Sets aside records of cells of this plan that other sources or other mesh files made, so that
/// nobody takes them for results of these.
std::size_t set_aside_outdated(const Plan& plan, const RecordStore& store,
                               SummaryCache& summaries) {
  using Place = std::tuple<std::string, std::string, std::string, std::string, int>;
  std::map<Place, std::string> planned;
  std::set<std::string> keys;
  for (const Cell& cell : plan.cells) {
    const PlannedShape& shape = plan.shapes[cell.shape];
    const PlannedScenario& scenario = shape.scenarios[cell.scenario];
    planned[{shape.label, scenario.scenario.family, scenario.name, plan.methods[cell.method].label,
             cell.repeat}] = cell.key;
    keys.insert(cell.key);
  }
  std::size_t count = 0;
  for (const auto& file : list_records(store.folder())) {
    const std::string key = file.stem().string();
    if (keys.contains(key)) continue;
    try {
      const CellSummary s = summaries.read(file);
      if (!planned.contains({s.shape, s.family, s.scenario, s.label, s.repeat})) continue;
    } catch (const DataError&) {
      // Of another version of the layout, or damaged: reports leave it out and say so.
      continue;
    }
    if (const auto claim = store.claim(key)) {
      store.set_aside(*claim, key, "outdated");
      ++count;
    }
  }
  return count;
}

}  // namespace

RunResult run_suite(const Plan& plan, const Catalog& catalog, const RunOptions& options) {
  const RecordStore store(options.folder);
  store.bind_suite({.name = plan.suite.name,
                    .summary = plan.suite.summary,
                    .values = to_json(plan.suite),
                    .cells = plan.suite_cells,
                    .command = options.command});
  for (const PlannedShape& shape : plan.shapes) store.write_shape(shape.digest, shape.shape.mesh);
  SummaryCache summaries(options.folder);
  const std::size_t outdated = set_aside_outdated(plan, store, summaries);
  if (outdated > 0 && options.message) {
    options.message(fmt::format(
        "{}: {} record{} of other sources of the program, of a method or of a mesh file "
        "set aside (*.h5.outdated) and measured again",
        options.folder.string(), outdated, outdated == 1 ? "" : "s"));
  }
  CellExecutor executor(plan, catalog, options.jobs == 1);
  ExecuteCell execute = options.execute;
  if (!execute) {
    execute = [&](const Cell& cell, Progress& progress, const std::stop_token& stop) {
      return executor.execute(cell, progress, stop);
    };
  }
  return Run(plan, options, store, summaries, std::move(execute)).finish();
}

}  // namespace fracbench
