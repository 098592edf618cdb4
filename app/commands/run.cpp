#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/command.h"
#include "app/command_progress.h"
#include "app/suite_arguments.h"
#include "core/error.h"
#include "harness/cost_model.h"
#include "harness/exit_code.h"
#include "harness/plan.h"
#include "harness/runner.h"
#include "harness/study.h"
#include "harness/suite_overrides.h"
#include "harness/terminal_progress.h"

namespace fracbench {

namespace {

struct RunArguments : SuiteArguments {
  std::string shard;
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
                     .command = command_of(arguments),
                     .jobs = arguments.jobs,
                     .stop = stop,
                     .progress = [&](const RunProgress& progress) { shown.update(progress); },
                     .message = [&](std::string_view text) { shown.message(text); },
                     .timed = arguments.jobs == 1};
  CellWorkers workers(plan, catalog, arguments);
  workers.measure_for(options);
  return run_suite(plan, catalog, options);
}

/// Whether methods learn from what is not there yet.
bool lacks_learning_data(const Plan& plan) {
  return learns(plan) && !has_learning_data(plan, plan.learning_folder);
}

/// What methods that learn need is made first; false: there is not enough of it.
bool make_what_is_learned(const Plan& plan, const Catalog& catalog, const RunArguments& arguments,
                          const std::stop_token& stop) {
  if (!lacks_learning_data(plan)) return true;
  const LearningResult result = make_learning_data(plan.suite, catalog, arguments, stop);
  return exit_code_of(result) == ExitCode::good;
}

/// What a suite costs at another of its scales, which may need what is not here.
void print_scale(const Suite& suite, const SuiteScale& scale, const Catalog& catalog,
                 const RunArguments& arguments, const std::stop_token& stop) {
  std::string cost, training;
  try {
    const Suite other = at_scale(suite, scale.name, catalog);
    PlanOptions options = arguments.plan;
    options.shapes.clear();
    const Plan plan = make_plan(other, catalog, options);
    cost = estimate_cost(plan, std::filesystem::path("results") / other.name, arguments.jobs)
               .describe();
    training = training_lines(measured_training_costs(plan, stop));
  } catch (const InputError& error) {
    const std::string why = error.what();
    cost = "cannot be planned here: " + why.substr(0, why.find('\n'));
  }
  fmt::print("--scale {} ({}): {}\n{}", scale.name, scale.summary, cost, training);
}

/// What there is to do, and what it costs as far as that is known.
void say_cost(const Suite& suite, const Plan& plan, const Catalog& catalog,
              const RunArguments& arguments, const std::stop_token& stop) {
  const CostEstimate cost = estimate_cost(plan, arguments.out, arguments.jobs);
  std::optional<CostEstimate> learning;
  if (lacks_learning_data(plan)) learning = learning_cost(suite, catalog, arguments);
  const std::vector<TrainingCost> training = measured_training_costs(plan, stop);
  if (arguments.as_json) {
    auto json = cost.as_json();
    if (learning) json["learning"] = learning->as_json();
    add_training(training, json);
    print_json(json);
    return;
  }
  if (learning) fmt::print("learning data, made first: {}\n", learning->describe());
  fmt::print("{}{}\n", training_lines(training), cost.describe());
  for (const SuiteScale& scale : suite.scales) {
    print_scale(suite, scale, catalog, arguments, stop);
  }
}

StudyCost measured_cost(const Suite& suite, const std::filesystem::path& folder,
                        const std::stop_token& stop) {
  const MeasuringNote note;
  return study_cost(suite, folder, stop);
}

void say_study_cost(const Suite& suite, const Catalog& catalog, const RunArguments& arguments,
                    const std::stop_token& stop) {
  const StudyCost cost = measured_cost(suite, arguments.out, stop);
  if (arguments.as_json) {
    print_json(cost.as_json());
    return;
  }
  fmt::print("{}\n", cost.describe());
  for (const SuiteScale& scale : suite.scales) {
    const Suite other = at_scale(suite, scale.name, catalog);
    fmt::print(
        "--scale {} ({}): {}\n", scale.name, scale.summary,
        measured_cost(other, std::filesystem::path("results") / other.name, stop).describe());
  }
}

/// Whether it was made now, with the progress on the terminal.
bool make_study_shown(const Suite& suite, const RunArguments& arguments,
                      const std::stop_token& stop) {
  CommandProgress progress;
  return make_study(suite, {.folder = arguments.out,
                            .command = command_of(arguments),
                            .threads = suite.threads_per_cell,
                            .stop = stop,
                            .progress = &progress,
                            .message = [](std::string_view text) {
                              fmt::print(stderr, "fracbench: {}\n", text);
                            }});
}

/// A suite that has a study instead of cells.
ExitCode run_study(const Suite& suite, const Catalog& catalog, const RunArguments& arguments,
                   const std::stop_token& stop) {
  if (arguments.dry_run) {
    say_study_cost(suite, catalog, arguments, stop);
    return ExitCode::good;
  }
  const std::string study = describe_study(study_settings(suite));
  bool made = false, stopped = false;
  try {
    made = make_study_shown(suite, arguments, stop);
  } catch (const Cancelled&) {
    stopped = true;
  }
  if (arguments.as_json) {
    print_json({{"study", study}, {"found", !made && !stopped}, {"stopped", stopped}});
  } else if (stopped) {
    fmt::print("{}: stopped; the same command goes on from here\n", study);
  } else {
    fmt::print("{}: {} {}\n", study, made ? "in" : "found in", arguments.out.string());
  }
  return stopped ? ExitCode::not_measured : ExitCode::good;
}

ExitCode run(RunArguments arguments, std::stop_token stop) {
  const Catalog catalog = built_in_catalog();
  const Suite suite = read_suite(arguments, catalog);
  if (suite.study) return run_study(suite, catalog, arguments, stop);
  if (suite.methods.empty()) {
    throw InputError(fmt::format("{}: the suite only makes learning data: fracbench prepare {}",
                                 suite.name, arguments.suite));
  }
  if (!arguments.shard.empty()) arguments.plan.shard = parse_shard(arguments.shard);
  Plan plan = make_plan(suite, catalog, arguments.plan);
  plan.learning_folder = arguments.learning_folder();

  if (arguments.dry_run) {
    say_cost(suite, plan, catalog, arguments, stop);
    return ExitCode::good;
  }
  const CostEstimate cost = estimate_cost(plan, arguments.out, arguments.jobs);
  if (!make_what_is_learned(plan, catalog, arguments, stop)) return ExitCode::not_measured;
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
  add_suite_options(*command, *a);
  command->add_option("--shard", a->shard, "Only part i of n of the cells: i/n");
  command->callback([&chosen, a] { chosen = [a](std::stop_token stop) { return run(*a, stop); }; });
}

}  // namespace fracbench
