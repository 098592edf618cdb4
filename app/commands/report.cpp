#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>

#include "app/command.h"
#include "app/command_progress.h"
#include "core/error.h"
#include "core/text.h"
#include "harness/build_info.h"
#include "harness/reference_agreement.h"
#include "harness/summaries.h"
#include "reports/latex/write_latex.h"
#include "reports/page/write_page.h"
#include "reports/write_report.h"

namespace fracbench {

namespace {

struct ReportArguments {
  std::filesystem::path results;
  std::filesystem::path out;
  std::vector<std::string> items;
  std::size_t cells = PageFilesOptions().cells;
  bool meshes = false;
};

/// Who measured it on what. Records of one folder may come from several machines.
std::vector<std::string> provenance_of(const Results& results) {
  std::map<std::string, std::size_t> cells_by_cpu;
  for (const CellSummary& cell : results.cells) ++cells_by_cpu[cell.cpu];
  std::vector<std::string> lines;
  if (!results.suite.summary.empty()) lines.push_back(results.suite.summary);
  const auto seed = results.suite.values.value("seed", std::uint64_t{1});
  if (results.suite.cells > 0) {
    lines.push_back(fmt::format("{} of the suite's {} cells have a record.", results.cells.size(),
                                results.suite.cells));
    lines.push_back(fmt::format("Seed {}, from which every random number follows; {} repeat(s).",
                                seed, results.suite.values.value("repeats", 1)));
  } else {
    lines.push_back(fmt::format("Seed {}, from which every random number follows.", seed));
  }
  for (const auto& [cpu, count] : cells_by_cpu) {
    lines.push_back(fmt::format("{} of them were measured on {}.", count, cpu));
  }
  const BuildInfo& build = build_info();
  lines.push_back(fmt::format("Report by fracbench {} ({}{}).", build.version, build.revision,
                              build.dirty ? ", with changes" : ""));
  return lines;
}

/// Draws from `results` and `folder`, which have to outlive it.
ReportInput input_from(const Results& results, const std::filesystem::path& folder) {
  return {.title = results.suite.name,
          .cells = results.cells,
          .study = results.study,
          .agreements = agreement_with_reference(folder, results.cells),
          .gallery = [&] { return gallery_of(folder, results.cells); },
          .provenance = provenance_of(results),
          .suite = results.suite.values.dump(),
          .bootstrap = {},
          .seed = results.suite.values.value("seed", std::uint64_t{1})};
}

/// That make the results and the report anew.
std::vector<std::string> commands_of(const Results& results) {
  const std::string folder = "results/" + results.suite.name;
  const std::string measure = results.suite.command.empty()
                                  ? "fracbench run " + shell_word(results.suite.name)
                                  : results.suite.command;
  return {fmt::format("{} --out {}", measure, shell_word(folder)),
          fmt::format("fracbench report {}", shell_word(folder))};
}

ExitCode report(ReportArguments arguments, const std::stop_token& stop) {
  if (arguments.out.empty()) arguments.out = arguments.results / "report";
  const Results results = read_results(arguments.results);
  for (const std::string& message : results.unreadable) {
    fmt::print(stderr, "fracbench: left out: {}\n", message);
  }
  if (results.cells.empty() && !results.study) {
    fmt::print(stderr, "fracbench: {}: holds no records; run the suite first: fracbench run {}\n",
               arguments.results.string(), results.suite.name);
    return ExitCode::not_measured;
  }
  const ReportInput input = input_from(results, arguments.results);
  const std::vector<NamedSection> sections = render_sections(input, arguments.items);
  const std::filesystem::path text = write_report(input, sections, arguments.out);
  write_files(render_latex(input, sections), arguments.out);
  CommandProgress progress;
  bool all_shown = true;
  const std::filesystem::path page = write_page(input, sections, arguments.results, arguments.out,
                                                {.commands = commands_of(results),
                                                 .cells = arguments.cells,
                                                 .meshes = arguments.meshes,
                                                 .stop = stop,
                                                 .progress = &progress,
                                                 .message = [&](std::string_view why) {
                                                   fmt::print(stderr, "fracbench: {}\n", why);
                                                   all_shown = false;
                                                 }});
  fmt::print("{}\n{}\n", text.string(), page.string());
  return results.unreadable.empty() && all_shown ? ExitCode::good : ExitCode::not_measured;
}

}  // namespace

void add_report_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand("report",
                                     "Tables, figures and fragments of a results folder: a page to "
                                     "look at, Markdown, CSV and SVG");
  auto a = std::make_shared<ReportArguments>();
  command->add_option("results", a->results, "Results folder of 'fracbench run'")->required();
  command->add_option("--out", a->out, "Folder of the report [<results>/report]");
  command
      ->add_option("--items", a->items,
                   "Only these sections, such as claims,fragment_counts (comma-separated); each "
                   "section of the page says its name")
      ->delimiter(',');
  command
      ->add_option("--cells", a->cells,
                   "How many cells the page shows one by one: the first collisions of each shape; "
                   "tables and figures are always of all")
      ->capture_default_str();
  command->add_flag("--meshes", a->meshes,
                    "Also the whole meshes of every cell shown, with their motion, as glTF");
  command->callback(
      [&chosen, a] { chosen = [a](const std::stop_token& stop) { return report(*a, stop); }; });
}

}  // namespace fracbench
