#include <fmt/format.h>

#include <memory>

#include "app/command.h"
#include "app/method_template.h"

namespace fracbench {

namespace {

struct NewArguments {
  std::string name;
  std::filesystem::path repository = ".";
};

ExitCode new_method(const NewArguments& a) {
  for (const auto& file : write_method_template(a.repository, a.name)) {
    fmt::print("wrote {}\n", file.string());
  }
  const std::vector<std::string> lines = registry_lines(a.name);
  fmt::print(
      "now in methods/registry.cpp: the line\n    {}\nand the class {} in the list of methods(); "
      "then\n    ./scripts/test.sh -R {}\n    build/release/bin/fracbench check {}\n"
      "and begin with 'fracture' in methods/{}; see docs/add-a-method.md\n",
      lines[0], lines[1], lines[1], a.name, a.name);
  return ExitCode::good;
}

}  // namespace

void add_new_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand("new", "Writes the beginning of something of your own");
  command->require_subcommand(1);
  auto* method = command->add_subcommand(
      "method", "A fracture method that builds and passes 'fracbench check'");
  auto a = std::make_shared<NewArguments>();
  method->add_option("name", a->name, "Such as plane-cutter")->required();
  method->add_option("--repository", a->repository, "Clone of fracbench")->capture_default_str();
  method->callback([&chosen, a] { chosen = [a](std::stop_token) { return new_method(*a); }; });
}

}  // namespace fracbench
