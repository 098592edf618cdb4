// The toy world of the harness's tests as a program:
//   toy_fracbench worker
//   toy_fracbench run FOLDER JOBS [KEY=VALUE ...]     fills a folder with the hostile suite

#include <cstdlib>
#include <string>
#include <string_view>

#include "core/freed_memory.h"
#include "harness/runner.h"
#include "harness/suite_overrides.h"
#include "harness/workers/serve_cells.h"
#include "harness/workers/worker_pool.h"
#include "hostile_method.h"
#include "toy_catalog.h"

/// Where the address sanitizer is built in: the toys' crashes are to be those of the system.
extern "C" const char* __asan_default_options() {
  return "handle_segv=0:handle_abort=0:handle_sigbus=0:detect_leaks=0";
}

int main(int argc, char** argv) {
  using namespace fracbench;
  keep_freed_memory();  // as the program does
  const ToyWorld world;
  const Catalog catalog = world.catalog();
  if (argc == 2 && std::string_view(argv[1]) == "worker") return serve_cells(catalog);
  if (argc < 4) return 2;
  Suite suite = hostile_suite(catalog);
  for (int k = 4; k < argc; ++k) suite = with_override(suite, argv[k], catalog);
  const Plan plan = make_plan(suite, catalog);
  WorkerPool pool(plan, catalog, {});
  const RunResult result = run_suite(
      plan, catalog,
      {.folder = argv[2],
       .jobs = std::atoi(argv[3]),
       .execute = [&](const Cell& cell, Progress& progress,
                      const std::stop_token& stop) { return pool.execute(cell, progress, stop); },
       .ready = [&](const Cell& cell) { return pool.ready(cell); }});
  return result.complete() ? 0 : 1;
}
