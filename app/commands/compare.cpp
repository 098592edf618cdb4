#include "harness/compare.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/command.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "harness/accept_baseline.h"
#include "reports/comparison_report.h"

namespace fracbench {

namespace {

struct CompareArguments {
  std::filesystem::path baseline;
  std::filesystem::path candidate;
  std::filesystem::path gates;
  std::filesystem::path junit;
  std::filesystem::path markdown;
  bool json = false;
  bool accept = false;
  std::string who;
  std::string why;
};

std::string user_name() {
  const passwd* user = ::getpwuid(::getuid());
  return user && user->pw_name ? user->pw_name : "";
}

void check_usage(const CompareArguments& a) {
  if (!a.accept && !(a.who.empty() && a.why.empty())) {
    throw InputError("--why and --who are notes of --accept, which was not given");
  }
  if (a.accept && a.why.empty()) {
    throw InputError("--accept needs a note of why the baseline changes: --why TEXT");
  }
}

/// Accepting needs no comparison: the first baseline has none, and a new suite is no regression.
ExitCode accept(const CompareArguments& a, const Comparison& comparison) {
  const Acceptance note = accept_baseline(a.baseline, a.candidate,
                                          {.when = "",
                                           .who = a.who.empty() ? user_name() : a.who,
                                           .why = a.why,
                                           .suite = "",
                                           .cells = 0});
  if (a.json) {
    auto json = comparison_json(comparison);
    json["accepted"] = {{"when", note.when}, {"who", note.who}, {"why", note.why}};
    print_json(json);
  } else {
    fmt::print("{}accepted as {} by {} at {}: {}\n", comparison_text(comparison),
               a.baseline.string(), note.who, note.when, note.why);
  }
  return ExitCode::good;
}

ExitCode compare(const CompareArguments& a) {
  check_usage(a);
  const auto gates = a.gates.empty() ? default_gates() : read_gates(a.gates);
  const Comparison comparison = compare_folders(a.baseline, a.candidate, gates);
  if (!a.junit.empty()) write_file_atomically(a.junit, comparison_junit(comparison));
  if (!a.markdown.empty()) write_file_atomically(a.markdown, comparison_markdown(comparison));
  if (a.accept) return accept(a, comparison);
  if (a.json) {
    print_json(comparison_json(comparison));
  } else {
    fmt::print("{}", comparison_text(comparison));
  }
  return comparison.exit_code;
}

}  // namespace

void add_compare_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
      "compare", "Judges results against a baseline: exit code 3 for a regression");
  auto a = std::make_shared<CompareArguments>();
  command
      ->add_option("baseline", a->baseline,
                   "Results folder to compare with, or their summary FILE.json")
      ->required();
  command->add_option("candidate", a->candidate, "Results folder to judge")->required();
  command->add_option("--gates", a->gates, "TOML file that says what must not change [built in]");
  command->add_flag("--json", a->json, "Print one JSON object");
  command->add_option("--junit", a->junit, "Write the verdict as JUnit XML");
  command->add_option("--markdown", a->markdown, "Write the verdict as Markdown");
  command->add_flag(
      "--accept", a->accept,
      "Make the candidate the new baseline: a copy, or with FILE.json a summary of it");
  command->add_option("--why", a->why, "Note of --accept: why the baseline changes");
  command->add_option("--who", a->who, "Note of --accept: who decided it [the user's name]");
  command->callback([&chosen, a] { chosen = [a](std::stop_token) { return compare(*a); }; });
}

}  // namespace fracbench
