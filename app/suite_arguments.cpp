#include "app/suite_arguments.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "harness/collision_store.h"
#include "harness/learning_plan.h"
#include "harness/suite_files.h"
#include "harness/suite_overrides.h"
#include "harness/suite_reader.h"
#include "harness/terminal_progress.h"

namespace fracbench {

std::filesystem::path SuiteArguments::learning_folder() const {
  return learning.empty() ? learning_folder_in(out) : learning;
}

void add_suite_options(CLI::App& command, SuiteArguments& a) {
  command.add_option("suite", a.suite, "Name of a suite ('fracbench list suites') or a TOML file")
      ->required();
  command.add_option("--scale", a.scale,
                     "One of the suite's other scales, such as paper; --dry-run shows them all");
  command.add_option("--out", a.out, "Results folder [results/<name of the suite>]");
  command.add_option(
      "--learning", a.learning,
      "Folder of the data that methods learn from [learning/ in the results folder]");
  command.add_option("--methods", a.plan.methods, "Only these methods (comma-separated)")
      ->delimiter(',');
  command.add_option("--shapes", a.plan.shapes, "Only these shapes (comma-separated)")
      ->delimiter(',');
  command
      .add_option(
          "--jobs", a.jobs,
          "Cells measured at a time, each in a process of its own; 1 for timings that count")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.add_option_function<std::string>(
      "--device", [&a](const std::string& device) { a.settings.push_back("device=" + device); },
      "cpu or cuda, for methods that can compute on one; the same as --set device=cuda");
  command
      .add_option("--set", a.settings,
                  "Change a value of the suite: seed=7, repeats=3, method.cvd.sites=40, "
                  "scenario.single.count=10, shape.*.resolution=20, timeout_s=60, memory_mb=4000, "
                  "learning.count=50")
      ->allow_extra_args(false)
      ->take_all();
  command.add_flag("--dry-run", a.dry_run, "Only say what there is to do, and what it costs");
  command.add_flag("--in-process", a.in_process,
                   "Measure in this process: for debuggers; a crash ends the run, and limits of "
                   "time and memory are not held");
  command.add_flag("--json", a.as_json, "Print the outcome as one JSON object");
}

Suite read_suite(SuiteArguments& a, const Catalog& catalog) {
  Suite suite = read_suite(find_suite_file(a.suite), catalog);
  if (!a.scale.empty()) suite = at_scale(std::move(suite), a.scale, catalog);
  for (const std::string& setting : a.settings) {
    suite = with_override(std::move(suite), setting, catalog);
  }
  if (a.out.empty()) a.out = std::filesystem::path("results") / suite.name;
  return suite;
}

std::string command_of(const SuiteArguments& a) {
  std::string command = "fracbench run " + shell_word(a.suite);
  if (!a.scale.empty()) command += " --scale " + shell_word(a.scale);
  for (const std::string& setting : a.settings) command += " --set " + shell_word(setting);
  return command;
}

CellWorkers::CellWorkers(const Plan& plan, const Catalog& catalog,
                         const SuiteArguments& arguments) {
  if (!arguments.in_process) pool_.emplace(plan, catalog, WorkerPoolOptions());
}

void CellWorkers::measure_for(RunOptions& options) {
  if (!pool_) return;
  options.execute = [this](const Cell& cell, Progress& progress, const std::stop_token& stop) {
    return pool_->execute(cell, progress, stop);
  };
  options.ready = [this](const Cell& cell) { return pool_->ready(cell); };
}

CostEstimate learning_cost(const Suite& suite, const Catalog& catalog, const SuiteArguments& a) {
  return estimate_cost(make_learning_plan(suite, catalog, learning_shapes(suite, a.plan)),
                       a.learning_folder(), a.jobs);
}

bool learns(const Plan& plan) {
  return std::ranges::any_of(plan.methods, [](const auto& method) { return method.info.learns; });
}

MeasuringNote::MeasuringNote() : shown_(is_terminal(STDERR_FILENO)) {
  if (shown_) fmt::print(stderr, "measuring some steps of training ...\r");
}

MeasuringNote::~MeasuringNote() {
  if (shown_) fmt::print(stderr, "{:36}\r", "");
}

std::vector<TrainingCost> measured_training_costs(const Plan& plan, const std::stop_token& stop) {
  if (!learns(plan)) return {};
  const MeasuringNote note;
  return training_costs(plan, stop);
}

std::string training_lines(const std::vector<TrainingCost>& costs) {
  std::string text;
  for (const TrainingCost& cost : costs) {
    text += fmt::format("training, where none is kept: {}\n", cost.describe());
  }
  return text;
}

void add_training(const std::vector<TrainingCost>& costs, nlohmann::ordered_json& json) {
  for (const TrainingCost& cost : costs) json["training"].push_back(cost.as_json());
}

LearningResult make_learning_data(const Suite& suite, const Catalog& catalog,
                                  const SuiteArguments& a, const std::stop_token& stop) {
  const Plan plan = make_learning_plan(suite, catalog, learning_shapes(suite, a.plan));
  const std::filesystem::path folder = a.learning_folder();
  fmt::print(stderr, "{}: {}\n", plan.suite.name, estimate_cost(plan, folder, a.jobs).describe());
  LearningResult result;
  {
    TerminalProgress shown(std::cerr, is_terminal(STDERR_FILENO), terminal_columns(STDERR_FILENO),
                           describe_learning);
    RunOptions options{.folder = folder,
                       .jobs = a.jobs,
                       .stop = stop,
                       .progress = [&](const RunProgress& progress) { shown.update(progress); },
                       .message = [&](std::string_view text) { shown.message(text); }};
    CellWorkers workers(plan, catalog, a);
    workers.measure_for(options);
    if (const auto store = CollisionStore::of_user(); store && options.execute) {
      options.execute = store->through(plan, options.execute);
    }
    result = make_learning_data(plan, suite.learning->split, catalog, options);
  }
  for (const std::string& line : result.shortages) fmt::print(stderr, "fracbench: {}\n", line);
  return result;
}

}  // namespace fracbench
