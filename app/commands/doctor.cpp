#include <fmt/format.h>
#include <sys/sysinfo.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/command.h"
#include "core/error.h"
#include "harness/provenance.h"
#include "harness/suite_files.h"
#include "methods/registry.h"
#include "neural/training_program.h"
#include "reports/page/write_page.h"
#include "scenarios/shapes.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double kGigabyte = 1e9;

/// One thing that was looked at.
Json finding(const std::string& name, bool good, const std::string& detail,
             const std::string& remedy = "") {
  Json item = {{"name", name}, {"ok", good}, {"detail", detail}};
  if (!good) item["remedy"] = remedy;
  return item;
}

Json memory() {
  struct sysinfo info = {};
  sysinfo(&info);
  const double unit = info.mem_unit / kGigabyte;
  const double all = static_cast<double>(info.totalram) * unit;
  return finding("memory", all >= 4, fmt::format("{:.1f} GB", all),
                 "building takes about 2.5 GB for each job: build with --parallel 1");
}

Json disk() {
  std::error_code error;
  const fs::space_info space = fs::space(".", error);
  if (error) return finding("disk", false, error.message(), "run from a folder that can be read");
  const double free = static_cast<double>(space.available) / kGigabyte;
  return finding("disk", free >= 1, fmt::format("{:.1f} GB free in this folder", free),
                 "free some space, or write results elsewhere with --out");
}

Json device() {
  return finding(
      "device", true,
      "cpu; run, prepare and fracbench-train take --device cuda where libtorch has CUDA");
}

Json trainer() {
  try {
    return finding("trainer", true, neural::training_program().string());
  } catch (const InputError& error) {
    return finding("trainer", false, "not here: deepfracture cannot be trained", error.what());
  }
}

Json viewer() {
  const bool there = has_viewer();
  return finding("viewer", there, there ? "in the pages of reports" : "not built",
                 "npm install --prefix third_party, and build again");
}

/// A program in one of the folders of PATH.
bool in_path(const std::string& program) {
  std::istringstream folders(std::getenv("PATH") ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::error_code ignored;
    if (fs::is_regular_file(fs::path(folder) / program, ignored)) return true;
  }
  return false;
}

Json latex() {
  const bool there = in_path("pdflatex");
  return finding("latex", there,
                 there ? "pdflatex" : "no pdflatex: reports have LaTeX files all the same",
                 "to compile them: Debian's texlive-latex-recommended and texlive-pictures");
}

Json shapes() {
  const std::vector<ShapeInfo> all = list_shapes();
  std::string missing;
  std::string remedy;
  for (const ShapeInfo& shape : all) {
    if (shape.available) continue;
    missing += (missing.empty() ? "" : ", ") + shape.name;
    remedy += (remedy.empty() ? "" : "\n") + fmt::format("{}: {}", shape.name, shape.how_to_get);
  }
  return finding("shapes", missing.empty(),
                 missing.empty() ? fmt::format("all {} are here", all.size())
                                 : fmt::format("not here: {}", missing),
                 remedy);
}

Json suites() {
  const std::size_t count = list_suites().size();
  return finding("suites", count > 0, fmt::format("{} found", count),
                 "set FRACBENCH_SUITES to the folder scenarios/suites of the sources");
}

Json look_at_everything() {
  Json findings = Json::array();
  for (const auto& [name, value] : collect_provenance()) {
    findings.push_back(finding(name, true, value));
  }
  findings.push_back(finding("methods", true, fmt::format("{} built in", methods().size())));
  for (const auto& look : {memory, disk, device, trainer, viewer, latex, shapes, suites})
    findings.push_back(look());
  return findings;
}

std::string indented(std::string text, const std::string& indent) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += indent.size()) {
    text.insert(++at, indent);
  }
  return indent + text;
}

ExitCode doctor(bool as_json) {
  const Json findings = look_at_everything();
  if (as_json) {
    print_json(findings);
    return ExitCode::good;
  }
  for (const Json& item : findings) {
    fmt::print("{} {:<16} {}\n", item["ok"] ? "  " : "! ", item["name"].get<std::string>(),
               item["detail"].get<std::string>());
    if (item.contains("remedy")) {
      fmt::print("{}\n", indented(item["remedy"].get<std::string>(), std::string(20, ' ')));
    }
  }
  return ExitCode::good;
}

}  // namespace

void add_doctor_command(CLI::App& app, Action& chosen) {
  auto* command =
      app.add_subcommand("doctor", "What is installed, what is missing and how to get it");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "As one JSON value");
  command->callback(
      [&chosen, as_json] { chosen = [as_json](std::stop_token) { return doctor(*as_json); }; });
}

}  // namespace fracbench
