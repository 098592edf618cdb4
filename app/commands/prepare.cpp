#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/command.h"
#include "app/suite_arguments.h"
#include "core/error.h"
#include "harness/breakable_cache.h"
#include "harness/cost_model.h"
#include "harness/learning_plan.h"
#include "harness/prepare_methods.h"
#include "harness/terminal_progress.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

/// What there is to do, before it is done.
ExitCode say_cost(const Suite& suite, const Plan& plan, const Catalog& catalog,
                  const SuiteArguments& a, const std::stop_token& stop) {
  Json json = Json::object();
  std::string text;
  if (!learning_shapes(suite, a.plan).empty()) {
    const CostEstimate cost = learning_cost(suite, catalog, a);
    json["learning"] = cost.as_json();
    text += fmt::format("learning data: {}\n", cost.describe());
  }
  if (!plan.methods.empty()) {
    const std::size_t bodies = bodies_of(plan).size();
    const std::vector<TrainingCost> training = measured_training_costs(plan, stop);
    json["bodies"] = bodies;
    add_training(training, json);
    text += fmt::format("bodies to prepare: {}\n{}", bodies, training_lines(training));
  }
  if (a.as_json) {
    print_json(json);
  } else {
    fmt::print("{}", text);
  }
  return ExitCode::good;
}

PrepareResult prepare_shown(const Plan& plan, const std::stop_token& stop) {
  TerminalProgress shown(std::cerr, is_terminal(STDERR_FILENO), terminal_columns(STDERR_FILENO));
  return prepare_methods(plan, {.stop = stop, .progress = [&](const RunProgress& progress) {
                                  shown.update(progress);
                                }});
}

void print_learning(const LearningResult& result, const SuiteArguments& a) {
  if (!result.index) {
    fmt::print("{} of {} collisions have a record in {}; the same command goes on from here\n",
               result.run.recorded(), result.run.cells, a.learning_folder().string());
    return;
  }
  for (const LearningShape& shape : result.index->shapes) fmt::print("{}\n", describe(shape));
  fmt::print("learning data in {}\n", a.learning_folder().string());
}

void print_prepared(const PrepareResult& result) {
  for (const PreparedRow& row : result.rows) {
    fmt::print("{} {}: {}\n", row.shape, row.method,
               row.failure.empty() ? fmt::format("prepared in {:.3g} s", row.seconds)
                                   : "failed: " + row.failure);
  }
  if (result.rows.size() < result.bodies) {
    fmt::print("stopped after {} of {} bodies\n", result.rows.size(), result.bodies);
  }
}

ExitCode prepare(SuiteArguments a, std::stop_token stop) {
  const Catalog catalog = built_in_catalog();
  const Suite suite = read_suite(a, catalog);
  if (suite.study) {
    throw InputError(
        fmt::format("{}: the suite is a study, which needs no preparation: fracbench "
                    "run {}",
                    suite.name, a.suite));
  }
  Plan plan = make_plan(suite, catalog, a.plan);
  plan.learning_folder = a.learning_folder();
  if (a.dry_run) return say_cost(suite, plan, catalog, a, stop);

  Json json = Json::object();
  ExitCode code = ExitCode::good;
  if (!learning_shapes(suite, a.plan).empty()) {
    const LearningResult result = make_learning_data(suite, catalog, a, stop);
    json["learning"] = to_json(result);
    json["learning"]["folder"] = a.learning_folder().string();
    if (!a.as_json) print_learning(result, a);
    code = exit_code_of(result);
  }
  if (code == ExitCode::good && !plan.methods.empty()) {
    const PrepareResult result = prepare_shown(plan, stop);
    json["prepared"] = to_json(result);
    if (!a.as_json) print_prepared(result);
    code = exit_code_of(result);
  }
  if (a.as_json) print_json(json);
  return code;
}

}  // namespace

void add_prepare_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
      "prepare",
      "Makes the learning data of a suite and prepares its methods; goes on where it was "
      "stopped");
  auto a = std::make_shared<SuiteArguments>();
  add_suite_options(*command, *a);
  command->callback(
      [&chosen, a] { chosen = [a](std::stop_token stop) { return prepare(*a, stop); }; });
}

}  // namespace fracbench
