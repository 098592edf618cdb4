#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "harness/catalog.h"
#include "harness/cost_model.h"
#include "harness/learning_data.h"
#include "harness/plan.h"
#include "harness/suite.h"
#include "harness/training_cost.h"
#include "harness/workers/worker_pool.h"

namespace fracbench {

/// What `run` and `prepare` are both told: a suite, changes to it, and which part of it.
struct SuiteArguments {
  std::string suite;
  std::filesystem::path out;
  std::filesystem::path learning;  ///< folder of learning data; empty: below `out`
  std::string scale;               ///< of the suite; empty: as it stands
  std::vector<std::string> settings;
  PlanOptions plan;
  int jobs = 1;
  bool dry_run = false;
  bool in_process = false;
  bool as_json = false;

  std::filesystem::path learning_folder() const;
};

void add_suite_options(CLI::App& command, SuiteArguments& arguments);

/// Reads the suite with all changes, and fills in the results folder. Throws InputError.
Suite read_suite(SuiteArguments& arguments, const Catalog& catalog);

/// The command that measures the whole suite again, as far as it decides the results.
std::string command_of(const SuiteArguments& arguments);

/// The processes in which cells are measured, unless the user wants them in this one.
class CellWorkers {
 public:
  CellWorkers(const Plan& plan, const Catalog& catalog, const SuiteArguments& arguments);
  /// The cells of a run with these options are measured here; to be kept until it has ended.
  void measure_for(RunOptions& options);

 private:
  std::optional<WorkerPool> pool_;
};

/// What making the learning data of the suite costs, for the part that was asked for.
CostEstimate learning_cost(const Suite& suite, const Catalog& catalog,
                           const SuiteArguments& arguments);

/// Whether any of the plan's methods learns from data.
bool learns(const Plan& plan);

/// Says on a terminal that some steps of training are measured, while it stands.
class MeasuringNote {
 public:
  MeasuringNote();
  ~MeasuringNote();
  MeasuringNote(const MeasuringNote&) = delete;
  MeasuringNote& operator=(const MeasuringNote&) = delete;

 private:
  const bool shown_;
};

/// What the plan's methods take to learn, measured while standard error says so.
std::vector<TrainingCost> measured_training_costs(const Plan& plan, const std::stop_token& stop);

/// A line for each of them.
std::string training_lines(const std::vector<TrainingCost>& costs);

/// As the list "training" of an object; left out where nothing is trained.
void add_training(const std::vector<TrainingCost>& costs, nlohmann::ordered_json& json);

/// Makes the learning data of the suite for the shapes that were asked for, with the progress on
/// standard error, and says there what came of it.
LearningResult make_learning_data(const Suite& suite, const Catalog& catalog,
                                  const SuiteArguments& arguments, const std::stop_token& stop);

}  // namespace fracbench
