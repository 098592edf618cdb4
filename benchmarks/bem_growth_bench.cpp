// Growth of 10 cracks through the paper's Squirrel (../shared/meshes/squirrel.obj; skipped where it
// is not there) by the `fast` law in a smooth stress given in closed form, so that only the cracks
// are measured: voxels of 0.01 and 0.02, crack mesh 0.1, up to 39 steps.

#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>

#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "methods/bem/fast_model.h"
#include "methods/bem/growth_law.h"
#include "methods/bem/propagate.h"
#include "source_folder.h"

namespace fracbench::bem {
namespace {

const std::filesystem::path kSquirrel =
    std::filesystem::path(FRACBENCH_SOURCE_DIR) / "../shared/meshes/squirrel.obj";

Mat3 stress_at(const Vec3& x) {
  Mat3 s;
  s << std::sin(2 * x[0] + 1), 0.4 * std::cos(x[1]), 0.3 * std::sin(x[2]),  //
      0.4 * std::cos(x[1]), std::cos(3 * x[1] + x[0]), 0.2,                 //
      0.3 * std::sin(x[2]), 0.2, 0.8 * std::sin(2 * x[2] + x[1]);
  return 1e7 * (s + 1.5 * Mat3::Identity());
}

std::vector<Mat3> stresses_at(std::span<const Vec3> points) {
  std::vector<Mat3> stresses;
  for (const Vec3& point : points) stresses.push_back(stress_at(point));
  return stresses;
}

void grow(benchmark::State& state) {
  if (!std::filesystem::exists(kSquirrel)) return state.SkipWithError("no squirrel.obj");
  const TriangleMesh body = normalized(read_mesh(kSquirrel), 1.9);
  const double voxel = 1e-3 * static_cast<double>(state.range(0));
  const SurfaceStress no_stress = surface_stress(body, std::vector<Mat3>(body.faces.size()));
  const SurfaceStress surface = surface_stress(body, stresses_at(no_stress.centers));
  FractureModel model;
  model.surface_stress = [&](std::span<const CrackSheet>) { return surface; };
  model.stress_intensity = fast_model(stresses_at, FastFactors::authors(), 6);
  const StrengthField strength(
      {.kind = StrengthKind::random, .seed = 4, .weibull_modulus = 3, .correlation_length = 0.3});
  PropagationOptions options;
  options.duration = 39 * options.mesh_size / rayleigh_speed(options.material);
  options.min_distance = 0.3;
  const CutLinks whole(body, voxel, 1);
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress};
  PropagationReport report;
  std::size_t triangles = 0;
  for (auto _ : state) {
    state.PauseTiming();
    CutLinks links = whole;
    state.ResumeTiming();
    const Propagation result = propagate({}, links, strength, model, options, context);
    report = result.report;
    triangles = 0;
    for (const Crack& crack : result.cracks) triangles += crack.surface.faces.size();
  }
  state.counters["cracks"] = static_cast<double>(report.new_cracks);
  state.counters["steps"] = report.steps;
  state.counters["area"] = report.area;
  state.counters["triangles"] = static_cast<double>(triangles);
}

void strength_field(benchmark::State& state) {
  const StrengthField strength({.kind = StrengthKind::random});
  Vec3 point(0.1, 0.2, 0.3);
  for (auto _ : state) {
    point.x() += 1e-3;
    benchmark::DoNotOptimize(strength.at(point));
  }
}

BENCHMARK(grow)->ArgName("voxel_mm")->Arg(10)->Arg(20)->Arg(40)->Unit(benchmark::kMillisecond);
BENCHMARK(strength_field)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace fracbench::bem
