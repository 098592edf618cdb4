// Time from a file to a checked mesh. Aim: 100,000 faces in at most 1 s on 2 cores, the test for
// self-intersections included.

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "core/peak_memory.h"
#include "geometry/check_mesh.h"
#include "geometry/read_mesh.h"
#include "geometry/write_mesh.h"
#include "source_folder.h"

namespace fracbench {
namespace {

/// A dented sphere of about `faces` faces.
TriangleMesh dented_sphere(int faces) {
  const int stacks = static_cast<int>(std::sqrt(faces / 4.0)) + 1, slices = 2 * stacks;
  TriangleMesh mesh;
  const auto point = [](double theta, double phi) {
    const double r = 0.95 * (1 + 0.1 * std::sin(9 * theta) * std::sin(7 * phi));
    return Vec3(r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi),
                r * std::cos(theta));
  };
  mesh.vertices.push_back(point(0, 0));
  for (int i = 1; i < stacks; ++i) {
    for (int j = 0; j < slices; ++j) {
      mesh.vertices.push_back(
          point(std::numbers::pi * i / stacks, 2 * std::numbers::pi * j / slices));
    }
  }
  mesh.vertices.push_back(point(std::numbers::pi, 0));
  const auto at = [&](int i, int j) { return 1 + (i - 1) * slices + j % slices; };
  const int bottom = static_cast<int>(mesh.vertices.size()) - 1;
  for (int j = 0; j < slices; ++j) {
    mesh.faces.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < stacks; ++i) {
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.faces.push_back({at(stacks - 1, j), bottom, at(stacks - 1, j + 1)});
  }
  return mesh;
}

/// A file that goes away at the end.
class GeneratedFile {
 public:
  explicit GeneratedFile(int faces)
      : path_(std::filesystem::temp_directory_path() /
              ("fracbench_load_" + std::to_string(::getpid()) + ".obj")) {
    write_mesh(path_, dented_sphere(faces));
  }
  ~GeneratedFile() { std::filesystem::remove(path_); }
  GeneratedFile(const GeneratedFile&) = delete;
  GeneratedFile& operator=(const GeneratedFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void load_and_check(benchmark::State& state, const std::filesystem::path& path) {
  reset_peak_memory();
  std::size_t faces = 0;
  for (auto _ : state) {
    const TriangleMesh mesh = read_mesh(path);
    const MeshReport report = check_mesh(mesh, {.threads = 2});
    if (!report.is_solid()) state.SkipWithError(report.describe().c_str());
    faces = mesh.faces.size();
  }
  state.counters["faces"] = static_cast<double>(faces);
  state.counters["peak_MB"] = static_cast<double>(peak_memory()) / 1e6;
}

void load_generated(benchmark::State& state) {
  const GeneratedFile file(static_cast<int>(state.range(0)));
  load_and_check(state, file.path());
}
BENCHMARK(load_generated)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

void load_squirrel(benchmark::State& state) {
  const std::filesystem::path path =
      std::filesystem::path(FRACBENCH_SOURCE_DIR) / "../shared/meshes/squirrel.obj";
  if (!std::filesystem::exists(path)) {
    state.SkipWithError("squirrel.obj is not beside the checkout");
    return;
  }
  load_and_check(state, path);
}
BENCHMARK(load_squirrel)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

void read_only(benchmark::State& state) {
  const GeneratedFile file(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(read_mesh(file.path()));
}
BENCHMARK(read_only)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();

void check_without_intersections(benchmark::State& state) {
  const TriangleMesh mesh = dented_sphere(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(check_mesh(mesh, {.self_intersections = false}));
  }
}
BENCHMARK(check_without_intersections)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace fracbench
