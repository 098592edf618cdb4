#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/arguments.h"
#include "app/command.h"
#include "app/command_progress.h"
#include "core/child_process.h"
#include "core/error.h"
#include "harness/conformance.h"
#include "methods/registry.h"
#include "scenarios/shapes.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
  std::string method;
  std::vector<std::string> settings;
  std::vector<std::string> shapes = {"cube"};
  std::vector<std::string> only;
  double impulse = 2e5;
  double seconds = 120;
  double memory_mb = 4000;
  bool inside = false;
  bool as_json = false;
};

CheckResult check_here(const CheckArguments& a, const std::string& shape, const std::string& name) {
  const Method& method = find_method(a.method);
  const Options options = parse_settings(method.options(), a.settings, a.method);
  if (method.learns(options)) {
    throw InputError(fmt::format(
        "{}: it learns first; give it what it learned, such as --set model=FILE", a.method));
  }
  const Target target{.name = shape, .mesh = load_shape({.name = shape}).mesh, .material = {}};
  return make_check(name, {.method = method,
                           .options = options,
                           .target = target,
                           .impulse = a.impulse,
                           .memory_mb = a.memory_mb});
}

/// The call of this program that makes one check.
std::vector<std::string> call_of(const CheckArguments& a, const std::string& shape,
                                 const std::string& name) {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  std::vector<std::string> call{self,       "check",       a.method,
                                "--shapes", shape,         "--only",
                                name,       "--impulse",   fmt::format("{}", a.impulse),
                                "--inside", "--memory-mb", fmt::format("{}", a.memory_mb)};
  for (const std::string& setting : a.settings) {
    call.emplace_back("--set");
    call.push_back(setting);
  }
  return call;
}

/// Asks for a stop when the time is over, or when the user does.
class Deadline {
 public:
  Deadline(double seconds, const std::stop_token& user)
      : user_(user, [this] { source_.request_stop(); }),
        timer_([this, seconds](std::stop_token end) {
          std::unique_lock lock(mutex_);
          if (!wake_.wait_for(lock, end, std::chrono::duration<double>(seconds),
                              [&] { return end.stop_requested(); })) {
            source_.request_stop();
          }
        }) {}
  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::stop_callback<std::function<void()>> user_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread timer_;
};

/// In a process of its own: what crashes or hangs is a finding.
CheckResult check_apart(const CheckArguments& a, const std::string& shape, const std::string& name,
                        const std::stop_token& stop) {
  std::string answer;
  ChildResult child;
  try {
    const Deadline deadline(a.seconds, stop);
    child = run_child(
        call_of(a, shape, name),
        {.stop = deadline.token(), .on_line = [&](std::string_view line) { answer = line; }});
  } catch (const Cancelled&) {
    if (stop.stop_requested()) throw;
    return {Conformity::failed, fmt::format("took longer than {:g} s", a.seconds)};
  }
  if (child.signal == 0 && child.exit_code == static_cast<int>(ExitCode::bad_input)) {
    throw InputError(child.said.starts_with("fracbench: ") ? child.said.substr(11) : child.said);
  }
  const Json json = Json::parse(answer, nullptr, false);
  if (!child.good() || !json.is_object()) {
    return {Conformity::failed, fmt::format("the process ended {}", child.describe())};
  }
  const std::string conformity = json.value("result", "");
  return {conformity == "passed"    ? Conformity::passed
          : conformity == "skipped" ? Conformity::skipped
                                    : Conformity::failed,
          json.value("detail", "")};
}

ExitCode check_inside(const CheckArguments& a) {
  const CheckResult result = check_here(a, a.shapes.front(), a.only.front());
  fmt::print("{}\n",
             Json{{"result", to_string(result.conformity)}, {"detail", result.detail}}.dump());
  return ExitCode::good;
}

ExitCode check(const CheckArguments& a, const std::stop_token& stop) {
  if (a.inside) return check_inside(a);
  std::vector<std::string> names = a.only;
  if (names.empty()) {
    for (const Check& check : conformance_checks()) names.push_back(check.name);
  }
  Json list = Json::array();
  int failures = 0;
  CommandProgress progress;
  for (const std::string& shape : a.shapes) {
    for (std::size_t n = 0; n < names.size(); ++n) {
      progress.update(fmt::format("{} {}", shape, names[n]),
                      static_cast<double>(n) / static_cast<double>(names.size()));
      const CheckResult result = check_apart(a, shape, names[n], stop);
      failures += result.conformity == Conformity::failed;
      list.push_back({{"shape", shape},
                      {"check", names[n]},
                      {"result", to_string(result.conformity)},
                      {"detail", result.detail}});
      if (!a.as_json) {
        fmt::print("{:8} {:10} {:13} {}\n", to_string(result.conformity), shape, names[n],
                   result.detail);
        std::fflush(stdout);
      }
    }
  }
  if (a.as_json) {
    print_json(list);
  } else {
    fmt::print("{}: {}\n", a.method,
               failures == 0 ? "conforms" : fmt::format("{} check(s) failed", failures));
  }
  return failures == 0 ? ExitCode::good : ExitCode::regression;
}

}  // namespace

void add_check_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
      "check",
      "Whether a method keeps what every method promises; each check in a process of its own");
  auto a = std::make_shared<CheckArguments>();
  command->add_option("method", a->method, "Name of a method ('fracbench list methods')")
      ->required();
  command->add_option("--set", a->settings, "An option of the method: name=value")
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--shapes", a->shapes, "Generated shapes (comma-separated)")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--only", a->only, "Only these checks (comma-separated)")->delimiter(',');
  command->add_option("--impulse", a->impulse, "Of the blows, N s")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--seconds", a->seconds, "That a check may take")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--memory-mb", a->memory_mb, "MiB that preparing and breaking may take")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--inside", a->inside, "")->group("");
  command->add_flag("--json", a->as_json, "Print the outcome as a JSON list");
  command->callback(
      [&chosen, a] { chosen = [a](const std::stop_token& stop) { return check(*a, stop); }; });
}

}  // namespace fracbench
