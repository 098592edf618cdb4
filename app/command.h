#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <stop_token>

#include "harness/exit_code.h"

namespace fracbench {

/// What the chosen subcommand does: given the token that Ctrl-C sets off, returns how the program
/// ends.
using Action = std::function<ExitCode(std::stop_token)>;

/// Each adds one subcommand; when the user chooses it, `chosen` becomes what it does.
void add_run_command(CLI::App& app, Action& chosen);
void add_prepare_command(CLI::App& app, Action& chosen);
void add_report_command(CLI::App& app, Action& chosen);
void add_render_command(CLI::App& app, Action& chosen);
void add_compare_command(CLI::App& app, Action& chosen);
void add_validate_command(CLI::App& app, Action& chosen);
void add_fracture_command(CLI::App& app, Action& chosen);
void add_score_command(CLI::App& app, Action& chosen);
void add_partition_command(CLI::App& app, Action& chosen);
void add_cache_command(CLI::App& app, Action& chosen);
void add_check_command(CLI::App& app, Action& chosen);
void add_new_command(CLI::App& app, Action& chosen);
void add_export_command(CLI::App& app, Action& chosen);
void add_export_learning_command(CLI::App& app, Action& chosen);
void add_list_command(CLI::App& app, Action& chosen);
void add_doctor_command(CLI::App& app, Action& chosen);

/// Prints one JSON value on standard output. Throws std::logic_error for a number that JSON does
/// not have (NaN, infinity).
void print_json(const nlohmann::ordered_json& value);

}  // namespace fracbench
