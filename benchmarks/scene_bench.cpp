#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>

#include "geometry/read_mesh.h"
#include "methods/registry.h"
#include "scenarios/families.h"
#include "scenarios/first_impact.h"
#include "scenarios/scene.h"
#include "scenarios/shapes.h"
#include "source_folder.h"

// Scenes of the family `single` on Squirrel where the development meshes are there, else on the
// generated mug: up to the first impact (no method), and whole ones with 30 pieces.
namespace fracbench {
namespace {

Target load_target() {
  const auto file =
      std::filesystem::path(FRACBENCH_SOURCE_DIR) / ".." / "shared" / "meshes" / "squirrel.obj";
  if (std::filesystem::exists(file)) {
    return {.name = "squirrel", .mesh = read_mesh(file), .material = {}};
  }
  return {.name = "mug", .mesh = load_shape({.name = "mug"}).mesh, .material = {}};
}

std::vector<Scenario> singles(const Target& target, double low, double high) {
  const ScenarioFamily& family = find_family("single");
  const Options options(family.options(),
                        {{"count", std::int64_t{8}}, {"speed_min", low}, {"speed_max", high}}, "");
  return family.scenes(options, target.name, 1);
}

void first_impact(benchmark::State& state) {
  const Target target = load_target();
  const std::vector<Scenario> scenes = singles(target, 25, 100);
  std::size_t k = 0;
  for (auto _ : state) {
    Random random(1);
    StageTimer timer;
    Progress progress;
    Context context{.random = random, .timer = timer, .progress = progress};
    benchmark::DoNotOptimize(find_first_impact(scenes[k++ % scenes.size()], target, context));
  }
}
BENCHMARK(first_impact)->Unit(benchmark::kMillisecond);

void whole_scene(benchmark::State& state) {
  const Target target = load_target();
  const std::vector<Scenario> scenes = singles(target, 80, 100);
  const Method& method = find_method("cvd");
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{.random = random, .timer = timer, .progress = progress};
  const Options options(method.options(), {{"sites", std::int64_t{30}}}, "cvd");
  const std::shared_ptr<const Breakable> breakable = method.prepare(target, {}, options, context);
  std::size_t k = 0;
  std::size_t fragments = 0;
  for (auto _ : state) {
    fragments +=
        run_scene(scenes[k++ % scenes.size()], target, breakable, context).fragments.size();
  }
  state.counters["fragments"] =
      benchmark::Counter(static_cast<double>(fragments), benchmark::Counter::kAvgIterations);
}
BENCHMARK(whole_scene)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fracbench
