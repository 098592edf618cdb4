#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/command.h"
#include "core/error.h"
#include "core/freed_memory.h"
#include "core/interrupt.h"
#include "core/temporary_folder.h"
#include "core/text.h"
#include "harness/build_info.h"
#include "harness/catalog.h"
#include "harness/workers/serve_cells.h"
#include "neural/blas_kernels.h"

namespace {

constexpr const char* kAbout =
    "Breaks the same shapes under the same impacts with different fracture methods, and measures\n"
    "the fragments.\n";

constexpr const char* kFooter =
    "\nFirst steps:\n"
    "  fracbench fracture cvd bunny --ball 3,0,0,-60,0,0 --out broken    break one shape\n"
    "  fracbench run quick --out results                                 measure a suite\n"
    "  fracbench report results                                          read the outcome\n"
    "\nExit codes: 0 good, 1 internal error, 2 usage or bad input, 3 regression found,\n"
    "4 nothing or not everything was measured, 5 baseline missing or not comparable.\n";

constexpr const char* kNoOutput = "standard output cannot be written; is the disk full?";

/// The library would only say that a subcommand is required.
void require_known_subcommand(const CLI::App& app, std::string_view first) {
  if (first.starts_with('-')) return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    names.push_back(command->get_name());
    if (names.back() == first) return;
  }
  throw fracbench::InputError(
      fmt::format("unknown subcommand '{}'{}", first, fracbench::did_you_mean(first, names)));
}

fracbench::ExitCode run_program(int argc, char** argv, std::stop_token stop) {
  using namespace fracbench;
  CLI::App app(kAbout, "fracbench");
  app.set_version_flag("--version", [] {
    const BuildInfo& build = build_info();
    return fmt::format("fracbench {} ({}{})", build.version, build.revision,
                       build.dirty ? ", with changes" : "");
  });
  app.require_subcommand(1);

  Action chosen;
  add_run_command(app, chosen);
  add_prepare_command(app, chosen);
  add_report_command(app, chosen);
  add_render_command(app, chosen);
  add_compare_command(app, chosen);
  add_validate_command(app, chosen);
  add_fracture_command(app, chosen);
  add_score_command(app, chosen);
  add_partition_command(app, chosen);
  add_cache_command(app, chosen);
  add_check_command(app, chosen);
  add_new_command(app, chosen);
  add_export_command(app, chosen);
  add_export_learning_command(app, chosen);
  add_list_command(app, chosen);
  add_doctor_command(app, chosen);
  app.footer(kFooter);  // now, since subcommands would inherit it

  if (argc == 1) {
    fmt::print(stderr, "{}", app.help());
    return ExitCode::bad_input;
  }
  require_known_subcommand(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ExitCode::good : ExitCode::bad_input;
  }
  return chosen(stop);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace fracbench;
  neural::use_fitting_blas_kernels(argv);
  keep_freed_memory();
  // What 'run' starts this program with; nobody else needs it.
  if (argc == 2 && std::string_view(argv[1]) == "worker") return serve_cells(built_in_catalog());
  const Interrupt interrupt;
  try {
    remove_abandoned_work_folders();
    const ExitCode code = run_program(argc, argv, interrupt.token());
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw InputError(kNoOutput);
    return static_cast<int>(code);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "fracbench: out of memory; a coarser mesh or fewer jobs need less\n");
    return static_cast<int>(ExitCode::not_measured);
  } catch (const std::system_error& error) {
    const bool no_output = std::ferror(stdout) != 0;
    fmt::print(stderr, "fracbench: {}\n", no_output ? kNoOutput : error.what());
    return static_cast<int>(no_output ? ExitCode::bad_input : exit_code_of(error));
  } catch (const std::exception& error) {
    fmt::print(stderr, "fracbench: {}\n", error.what());
    return static_cast<int>(exit_code_of(error));
  }
}
