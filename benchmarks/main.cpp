// For the benchmarks without a main of their own: BENCHMARK_MAIN with the allocator as in the
// program.

#include <benchmark/benchmark.h>

#include "core/freed_memory.h"

int main(int argc, char** argv) {
  fracbench::keep_freed_memory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
