// Cracks of the method bem: a penny in an infinite body, stress intensities from an opening, and
// one step of the full model with a half-penny carved into a block.

#include <benchmark/benchmark.h>

#include <array>
#include <span>
#include <vector>

#include "core/progress.h"
#include "methods/bem/crack_system.h"
#include "methods/bem/full_model.h"
#include "methods/bem/stress_intensity.h"
#include "methods/bem/validation/crack_meshes.h"

namespace {

using namespace fracbench;
using namespace fracbench::bem;

const Mat3 kStress = 1e6 * Vec3::UnitY() * Vec3::UnitY().transpose();

struct Surroundings {
  Random random{1};
  StageTimer timer;
  Progress progress;
  Context context{.random = random, .timer = timer, .progress = progress, .threads = 2};
};

/// 6 rings^2 triangles: 16 rings are 1536. The floor is 2.5 s at 1500.
void penny_in_infinite_body(benchmark::State& state) {
  Surroundings around;
  const CrackSheet disc = disc_crack(0.2, static_cast<int>(state.range(0)));
  const Mat3 stress = 1e6 * Mat3::Identity();
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        openings_in_infinite_body({&disc, 1}, stress, Material{}, around.context));
  }
  state.counters["triangles"] = static_cast<double>(disc.mesh.faces.size());
}
BENCHMARK(penny_in_infinite_body)
    ->Arg(4)
    ->Arg(8)
    ->Arg(16)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void stress_intensities(benchmark::State& state) {
  const CrackSheet disc = disc_crack(0.2, 16);
  const std::vector<Vec3> opening(disc.mesh.vertices.size(), Vec3(1e-6, 0, 1e-6));
  for (auto _ : state) {
    benchmark::DoNotOptimize(stress_intensity_from_opening(disc, opening, Material{}));
  }
}
BENCHMARK(stress_intensities)->Unit(benchmark::kMicrosecond);

/// The front moves to and fro: what is carved and assembled anew in a step.
void step_of_full_model(benchmark::State& state) {
  Surroundings around;
  const CrackedBody body = half_penny_block(4, 4);
  FullModel model(
      body.surface,
      [](std::span<const Vec3> points) { return std::vector<Mat3>(points.size(), kStress); },
      std::vector<Mat3>(body.surface.faces.size(), kStress), Material{}, around.context);
  std::array<CrackSheet, 2> cracks{body.crack, body.crack};
  for (std::size_t i = 0; i < 2; ++i) {
    for (Vec3& v : cracks[i].mesh.vertices) {
      if (v.z() == 0) v.z() = 0.05;
      if (v.norm() > 0.99 && i == 1) v *= 1.1;
    }
  }
  model.stress_intensity({&cracks[0], 1});
  std::size_t step = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(model.stress_intensity({&cracks[++step % 2], 1}));
  }
  state.counters["unknowns"] = static_cast<double>(model.last_unknowns());
  state.counters["assembled"] = static_cast<double>(model.last_assembled());
}
BENCHMARK(step_of_full_model)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
