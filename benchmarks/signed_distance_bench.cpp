// Signed distances of the paper's Squirrel (../shared/meshes/squirrel.obj, 17596 faces; skipped
// where it is not there) on the grids that learning uses. Every sample is exact, far ones included:
// there is no narrow band. The limit is 0.4 s at 128^3 on 2 cores, 0.8 s of processor time.
// Measured on an AMD EPYC: 0.61 s of processor time, the tree's 0.013 s included, so about 0.31 s
// on two cores that nothing else uses. What remains is arithmetic: 26 tests of four boxes and 8 of
// triangles for a sample, the former shared by bricks of eight samples.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "geometry/isosurface.h"
#include "geometry/read_mesh.h"
#include "geometry/signed_distance_grid.h"
#include "geometry/surface_distance.h"
#include "scenarios/shapes/generated_shapes.h"
#include "source_folder.h"

namespace fracbench {
namespace {

const std::filesystem::path squirrel =
    std::filesystem::path(FRACBENCH_SOURCE_DIR) / "../shared/meshes/squirrel.obj";

void squirrel_grid(benchmark::State& state) {
  if (!std::filesystem::exists(squirrel)) return state.SkipWithError("no squirrel.obj");
  const TriangleMesh mesh = read_mesh(squirrel);
  const auto r = static_cast<int>(state.range(0));
  const auto threads = static_cast<int>(state.range(1));
  for (auto _ : state) {
    benchmark::DoNotOptimize(signed_distance_grid(mesh, unit_grid<float>(r), threads));
  }
  state.counters["samples/s"] =
      benchmark::Counter(double(r) * r * r, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(squirrel_grid)
    ->ArgNames({"r", "threads"})
    ->Args({64, 2})
    ->Args({128, 1})
    ->Args({128, 2})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void squirrel_tree(benchmark::State& state) {
  if (!std::filesystem::exists(squirrel)) return state.SkipWithError("no squirrel.obj");
  const TriangleMesh mesh = read_mesh(squirrel);
  for (auto _ : state) benchmark::DoNotOptimize(SurfaceDistance(mesh));
}
BENCHMARK(squirrel_tree)->Unit(benchmark::kMillisecond);

void sphere_isosurface(benchmark::State& state) {
  const auto r = static_cast<int>(state.range(0));
  const VoxelGrid<float> field = signed_distance_grid(sphere_mesh(16), unit_grid<float>(r, 0));
  for (auto _ : state) benchmark::DoNotOptimize(isosurface(field, -0.05f));
}
BENCHMARK(sphere_isosurface)->Arg(128)->Unit(benchmark::kMillisecond);

void generated_shape(benchmark::State& state) {
  const GeneratedShape& shape = generated_shapes()[state.range(0)];
  state.SetLabel(std::string(shape.name));
  for (auto _ : state) benchmark::DoNotOptimize(shape.make(shape.default_resolution));
}
BENCHMARK(generated_shape)->DenseRange(0, 7)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fracbench
