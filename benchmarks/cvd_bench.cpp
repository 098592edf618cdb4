// The method cvd on the paper's Squirrel (../shared/meshes/squirrel.obj; skipped where it is not
// there): preparation, and a whole fracture with the time of each of its stages.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "methods/registry.h"
#include "source_folder.h"

namespace fracbench {
namespace {

const std::filesystem::path kSquirrel =
    std::filesystem::path(FRACBENCH_SOURCE_DIR) / "../shared/meshes/squirrel.obj";

Impact push_at(const Vec3& point) {
  Impulse impulse;
  impulse.point = point;
  impulse.direction = Vec3(1, 0, 0);
  impulse.normal = Vec3(-1, 0, 0);
  impulse.magnitude = 100;
  Impact impact;
  impact.impulses.push_back(impulse);
  return impact;
}

void prepare(benchmark::State& state) {
  if (!std::filesystem::exists(kSquirrel)) return state.SkipWithError("no squirrel.obj");
  const Target target{"squirrel", read_mesh(kSquirrel), {}};
  const Method& cvd = find_method("cvd");
  const Options options(cvd.options(), {{"sites", std::int64_t{30}}}, "benchmark");
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress};
  for (auto _ : state) {
    benchmark::DoNotOptimize(cvd.prepare(target, {}, options, context));
  }
}

void fracture(benchmark::State& state) {
  if (!std::filesystem::exists(kSquirrel)) return state.SkipWithError("no squirrel.obj");
  const Target target{"squirrel", read_mesh(kSquirrel), {}};
  const Method& cvd = find_method("cvd");
  const Options options(cvd.options(), {{"sites", state.range(0)}}, "benchmark");
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress};
  const auto body = cvd.prepare(target, {}, options, context);

  StageTimer stages;
  double volume_ratio = 0;
  std::size_t pieces = 0;
  for (auto _ : state) {
    Random again(1);
    Context run{again, stages, progress};
    run.threads = static_cast<int>(state.range(1));
    const std::vector<Piece> result = body->fracture(push_at(target.mesh.vertices[0]), run);
    state.PauseTiming();
    pieces = result.size();
    volume_ratio = 0;
    for (const Piece& piece : result) volume_ratio += volume(piece.mesh) / volume(target.mesh);
    state.ResumeTiming();
  }
  for (const StageTime& time : stages.times()) {
    state.counters[time.name + "_ms"] =
        benchmark::Counter(1000 * time.seconds, benchmark::Counter::kAvgIterations);
  }
  state.counters["pieces"] = static_cast<double>(pieces);
  state.counters["volume_error"] = volume_ratio - 1;
}

BENCHMARK(prepare)->Unit(benchmark::kMillisecond);
BENCHMARK(fracture)
    ->ArgNames({"sites", "threads"})
    ->ArgsProduct({{10, 30, 100, 1000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace fracbench
