#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "harness/catalog.h"
#include "harness/cost_model.h"
#include "harness/exit_code.h"
#include "harness/plan.h"
#include "harness/runner.h"
#include "harness/suite_files.h"
#include "harness/suite_overrides.h"
#include "harness/suite_reader.h"
#include "harness/terminal_progress.h"
#include "harness/workers/worker_pool.h"

namespace fracbench {

namespace {

struct RunArguments {
  std::string suite;
  std::filesystem::path out;
  std::vector<std::string> settings;
  PlanOptions plan;
  std::string shard;
  int jobs = 1;
  bool dry_run = false;
  bool in_process = false;
  bool as_json = false;
};

void print_result(const RunResult& result, const RunArguments& arguments) {
  std::string counts;
  for (const auto& [status, count] : result.counts) {
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, to_string(status));
  }
  fmt::print("{} of {} cells have a record in {}: {}\n", result.recorded(), result.cells,
             arguments.out.string(), counts.empty() ? "none" : counts);
  if (result.stopped) fmt::print("stopped; the same command goes on from here\n");
}

/// With the progress on the terminal, whose line has ended when this returns.
RunResult run_shown(const Plan& plan, const Catalog& catalog, const RunArguments& arguments,
                    const std::stop_token& stop) {
  TerminalProgress shown(std::cerr, is_terminal(STDERR_FILENO), terminal_columns(STDERR_FILENO));
  RunOptions options{.folder = arguments.out,
                     .jobs = arguments.jobs,
                     .stop = stop,
                     .progress = [&](const RunProgress& progress) { shown.update(progress); },
                     .message = [&](std::string_view text) { shown.message(text); },
                     .timed = arguments.jobs == 1};
  if (arguments.in_process) return run_suite(plan, catalog, options);
  WorkerPool pool(plan, catalog, {});
  options.execute = [&](const Cell& cell, Progress& progress, const std::stop_token& asked) {
    return pool.execute(cell, progress, asked);
  };
  options.ready = [&](const Cell& cell) { return pool.ready(cell); };
  return run_suite(plan, catalog, options);
}

ExitCode run(RunArguments arguments, std::stop_token stop) {
  const Catalog catalog = built_in_catalog();
  const std::filesystem::path file = find_suite_file(arguments.suite);
  Suite suite = read_suite(file, catalog);
  for (const std::string& setting : arguments.settings) {
    suite = with_override(std::move(suite), setting, catalog);
  }
  if (arguments.out.empty()) arguments.out = std::filesystem::path("results") / suite.name;
  if (!arguments.shard.empty()) arguments.plan.shard = parse_shard(arguments.shard);
  const Plan plan = make_plan(suite, catalog, arguments.plan);

  const CostEstimate cost = estimate_cost(plan, arguments.out, arguments.jobs);
  if (arguments.dry_run) {
    if (arguments.as_json) {
      print_json(cost.as_json());
    } else {
      fmt::print("{}\n", cost.describe());
    }
    return ExitCode::good;
  }
  fmt::print(stderr, "{}: {}\n", plan.suite.name, cost.describe());
  const RunResult result = run_shown(plan, catalog, arguments, stop);
  if (arguments.as_json) {
    print_json(counts_as_json(result));
  } else {
    print_result(result, arguments);
  }
  return exit_code_of(result);
}

}  // namespace

void add_run_command(CLI::App& app, Action& chosen) {
  auto* command =
      app.add_subcommand("run", "Measure a suite; goes on where an earlier run of it was stopped");
  auto a = std::make_shared<RunArguments>();
  command->add_option("suite", a->suite, "Name of a suite ('fracbench list suites') or a TOML file")
      ->required();
  command->add_option("--out", a->out, "Results folder [results/<name of the suite>]");
  command->add_option("--methods", a->plan.methods, "Only these methods (comma-separated)")
      ->delimiter(',');
  command->add_option("--shapes", a->plan.shapes, "Only these shapes (comma-separated)")
      ->delimiter(',');
  command
      ->add_option(
          "--jobs", a->jobs,
          "Cells measured at a time, each in a process of its own; 1 for timings that count")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command
      ->add_option("--set", a->settings,
                   "Change a value of the suite: seed=7, repeats=3, method.cvd.sites=40, "
                   "scenario.single.count=10, shape.*.resolution=20, timeout_s=60, memory_mb=4000")
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--shard", a->shard, "Only part i of n of the cells: i/n");
  command->add_flag("--dry-run", a->dry_run, "Only say what there is to do, and what it costs");
  command->add_flag("--in-process", a->in_process,
                    "Measure in this process: for debuggers; a crash ends the run, and limits of "
                    "time and memory are not held");
  command->add_flag("--json", a->as_json, "Print the outcome as one JSON object");
  command->callback([&chosen, a] { chosen = [a](std::stop_token stop) { return run(*a, stop); }; });
}

}  // namespace fracbench
