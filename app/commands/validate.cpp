#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "harness/cost_model.h"
#include "harness/terminal_progress.h"
#include "harness/validation_run.h"
#include "methods/registry.h"
#include "reports/accuracy_table.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

struct ValidateArguments {
  std::string method;
  std::vector<std::string> cases;
  std::filesystem::path out;
  std::int64_t seed = 1;
  int threads = 2;
  bool list = false;
  bool as_json = false;
};

ExitCode say_no_cases(const ValidateArguments& a) {
  std::vector<std::string> others;
  for (const auto& method : methods()) {
    if (!method->validation().empty()) others.push_back(method->info().name);
  }
  fmt::print(stderr, "fracbench: method '{}' has no validation cases{}\n", a.method,
             others.empty() ? "; no method has any yet"
                            : fmt::format("; these have: {}", fmt::join(others, ", ")));
  if (a.as_json) print_json(Json::array());
  return ExitCode::not_measured;
}

ExitCode list_cases(const std::vector<ValidationCase>& cases, bool as_json) {
  std::size_t width = 0;
  Json list = Json::array();
  for (const ValidationCase& c : cases) {
    width = std::max(width, c.name.size());
    list.push_back({{"name", c.name}, {"summary", c.summary}, {"seconds", c.seconds}});
  }
  if (as_json) {
    print_json(list);
    return ExitCode::good;
  }
  for (const ValidationCase& c : cases) {
    fmt::print("  {:<{}}  {} (about {})\n", c.name, width, c.summary, describe_seconds(c.seconds));
  }
  return ExitCode::good;
}

ValidationRun run_shown(const std::vector<ValidationCase>& cases, const ValidateArguments& a,
                        const std::stop_token& stop) {
  TerminalProgress shown(std::cerr, is_terminal(STDERR_FILENO), terminal_columns(STDERR_FILENO));
  return run_validation(cases,
                        {.seed = static_cast<std::uint64_t>(a.seed),
                         .threads = a.threads,
                         .stop = stop,
                         .progress = [&](const RunProgress& progress) { shown.update(progress); },
                         .case_done =
                             [&](const ValidationRun& run) {
                               if (!a.out.empty()) write_accuracy(run, a.method, a.out);
                             }});
}

void print_run(const ValidationRun& run, const ValidateArguments& a) {
  const Table table = accuracy_table(run, a.method);
  fmt::print("{}\n", to_markdown(table));
  fmt::print("{} of {} values within their tolerance\n", run.rows.size() - run.failed(),
             run.rows.size());
  if (run.done < run.cases) fmt::print("stopped after {} of {} cases\n", run.done, run.cases);
  if (!a.out.empty()) fmt::print("written to {}\n", (a.out / "accuracy.md").string());
}

ExitCode validate(ValidateArguments a, std::stop_token stop) {
  const Method& method = find_method(a.method);
  const std::vector<ValidationCase> all = method.validation();
  if (all.empty()) return say_no_cases(a);
  const std::vector<ValidationCase> cases = select_cases(all, a.cases, a.method);
  if (a.list) return list_cases(cases, a.as_json);
  // The table of a few cases must not take the place of the whole one unasked.
  if (a.out.empty() && cases.size() == all.size()) {
    a.out = std::filesystem::path("results") / ("validate-" + a.method);
  }
  if (!a.out.empty()) {
    // Before the work, so that a folder that cannot be written costs nothing.
    write_accuracy({.rows = {}, .cases = cases.size()}, a.method, a.out);
  }
  const ValidationRun run = run_shown(cases, a, stop);
  if (a.as_json) {
    print_json(accuracy_json(run));
  } else {
    print_run(run, a);
  }
  return exit_code_of(run);
}

}  // namespace

void add_validate_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
      "validate",
      "Holds a method to closed forms and published results: exit code 3 where it fails");
  auto a = std::make_shared<ValidateArguments>();
  command->add_option("method", a->method, "Name of the method; see 'fracbench list methods'")
      ->required();
  command->add_option("case", a->cases, "Only these cases; see --list");
  command->add_option("--out", a->out,
                      "Folder for accuracy.md and accuracy.csv [results/validate-<method>, none "
                      "where only some cases are asked for]");
  command->add_option("--threads", a->threads, "Threads that the method may use")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--seed", a->seed, "Of the random choices in the cases")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
  command->add_flag("--list", a->list, "Only list the cases");
  command->add_flag("--json", a->as_json, "Print the table as one JSON array");
  command->callback(
      [&chosen, a] { chosen = [a](std::stop_token stop) { return validate(*a, stop); }; });
}

}  // namespace fracbench
