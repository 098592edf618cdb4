#include "harness/validation_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/error.h"
#include "core/text.h"

namespace fracbench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kProgressInterval = std::chrono::milliseconds(200);

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The time left, from what the cases say they take and how much longer those that are done took.
class TimeLeft {
 public:
  explicit TimeLeft(std::span<const ValidationCase> cases) {
    for (const ValidationCase& c : cases) waiting_ += c.seconds;
  }
  void start(const ValidationCase& c) {
    running_ = c.seconds;
    waiting_ -= c.seconds;
    begin_ = Clock::now();
  }
  void end() {
    stated_ += running_;
    taken_ += seconds_since(begin_);
  }
  double seconds() const {
    const double ratio = stated_ > 0 ? taken_ / stated_ : 1;
    return std::max(0.0, ratio * running_ - seconds_since(begin_)) + ratio * waiting_;
  }

 private:
  double waiting_ = 0;
  double running_ = 0;
  double stated_ = 0;
  double taken_ = 0;
  Clock::time_point begin_;
};

/// Passes on what a case says of itself.
class CaseProgress final : public Progress {
 public:
  CaseProgress(const ValidationOptions& options, const ValidationRun& run, const TimeLeft& left)
      : options_(options), run_(run), left_(left) {}

  void start(std::string_view name) {
    name_ = name;
    show(name_);
  }
  void update(std::string_view what, double fraction) override {
    if (Clock::now() - last_ < kProgressInterval) return;
    show(fmt::format("{}: {} {:.0f} %", name_, what, 100 * fraction));
  }
  void show(std::string running) {
    last_ = Clock::now();
    if (!options_.progress) return;
    RunProgress progress{.cells = run_.cases,
                         .done = run_.done,
                         .found = 0,
                         .failed = failed_,
                         .unbroken = 0,
                         .seconds = seconds_since(begin_),
                         .seconds_left = left_.seconds(),
                         .running = {}};
    if (!running.empty()) progress.running.push_back(std::move(running));
    options_.progress(progress);
  }
  void count_failed() { ++failed_; }

 private:
  const ValidationOptions& options_;
  const ValidationRun& run_;
  const TimeLeft& left_;
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point last_;
  std::string name_;
  std::size_t failed_ = 0;
};

AccuracyRow failed_row(const ValidationCase& c, std::string reason) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {.group = c.name,
          .accuracy = {.name = c.summary.empty() ? c.name : c.summary,
                       .reference = "",
                       .expected = kNone,
                       .computed = kNone,
                       .tolerance = kNone},
          .failure = std::move(reason)};
}

std::vector<AccuracyRow> run_case(const ValidationCase& c, const ValidationOptions& options,
                                  Progress& progress) {
  StageTimer timer;
  Random random(derive_seed(options.seed, {"validation", c.name}));
  Context context{.random = random,
                  .timer = timer,
                  .progress = progress,
                  .stop = options.stop,
                  .threads = options.threads};
  try {
    std::vector<AccuracyRow> rows;
    for (Accuracy& accuracy : c.run(context)) {
      rows.push_back({.group = c.name, .accuracy = std::move(accuracy)});
    }
    if (rows.empty()) return {failed_row(c, "the case gave no values")};
    return rows;
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    return {failed_row(c, "the memory of this process was not enough")};
  } catch (const std::exception& error) {
    return {failed_row(c, error.what())};
  }
}

}  // namespace

std::size_t ValidationRun::failed() const {
  return static_cast<std::size_t>(std::ranges::count(rows, false, &AccuracyRow::pass));
}

std::vector<ValidationCase> select_cases(std::vector<ValidationCase> cases,
                                         std::span<const std::string> names,
                                         std::string_view method) {
  if (names.empty()) return cases;
  std::vector<std::string> known;
  for (const ValidationCase& c : cases) known.push_back(c.name);
  for (const std::string& name : names) {
    if (std::ranges::find(known, name) == known.end()) {
      throw InputError(fmt::format("method '{}' has no validation case '{}'{}", method, name,
                                   did_you_mean(name, known)));
    }
  }
  std::erase_if(cases, [&](const ValidationCase& c) {
    return std::ranges::find(names, c.name) == names.end();
  });
  return cases;
}

ValidationRun run_validation(std::span<const ValidationCase> cases,
                             const ValidationOptions& options) {
  ValidationRun run{.rows = {}, .cases = cases.size()};
  TimeLeft left(cases);
  CaseProgress progress(options, run, left);
  try {
    for (const ValidationCase& c : cases) {
      if (options.stop.stop_requested()) throw Cancelled();
      left.start(c);
      progress.start(c.name);
      std::vector<AccuracyRow> rows = run_case(c, options, progress);
      left.end();
      ++run.done;
      if (!std::ranges::all_of(rows, &AccuracyRow::pass)) progress.count_failed();
      std::ranges::move(rows, std::back_inserter(run.rows));
      if (options.case_done) options.case_done(run);
    }
    progress.show("");
  } catch (const Cancelled&) {
    run.stopped = true;
  }
  return run;
}

ExitCode exit_code_of(const ValidationRun& run) {
  if (run.done < run.cases || run.cases == 0) return ExitCode::not_measured;
  return run.failed() == 0 ? ExitCode::good : ExitCode::regression;
}

}  // namespace fracbench
