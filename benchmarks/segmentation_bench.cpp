// Caged-SDF segmentation of the paper's Squirrel (../shared/meshes/squirrel.obj; skipped where it
// is not there) cut by a Voronoi diagram of 20 sites, whole calls, at r = 64, 128 and 256.
//
// Limits on 2 cores: by default 20 ms, 150 ms and 1.5 s; under parity 45 ms, 400 ms and 5 s; memory
// at r = 256 1.5 GB. Beside the mean time stand the shortest one (of the clock, and of the
// processor), the limit, the peak of memory during the call (that of
// the field included, 4 bytes a voxel) and what was found.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <map>
#include <vector>

#include "core/peak_memory.h"
#include "core/random.h"
#include "geometry/caged_sdf_segmentation.h"
#include "geometry/read_mesh.h"
#include "geometry/signed_distance_grid.h"
#include "geometry/surface_distance.h"
#include "source_folder.h"

namespace fracbench {
namespace {

const std::filesystem::path kSquirrel =
    std::filesystem::path(FRACBENCH_SOURCE_DIR) / "../shared/meshes/squirrel.obj";

/// Longest side 1.9, centred at the origin.
TriangleMesh normalised(TriangleMesh mesh) {
  Vec3 low = mesh.vertices[0], high = low;
  for (const Vec3& x : mesh.vertices) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  for (Vec3& x : mesh.vertices) x = (x - (low + high) / 2) * (1.9 / (high - low).maxCoeff());
  return mesh;
}

/// The distance to the mesh or to the nearest bisector of two sites, negative outside, in [-1, 1].
VoxelGrid<float> squirrel_in_pieces(int r) {
  const TriangleMesh mesh = normalised(read_mesh(kSquirrel));
  const SurfaceDistance surface(mesh);
  Random random(20251);
  std::vector<Vec3> sites;
  while (sites.size() < 20) {
    const Vec3 x(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (surface.inside(x)) sites.push_back(x);
  }
  VoxelGrid<float> field = signed_distance_grid(mesh, unit_grid<float>(r));
  for (int k = 0; k < r; ++k) {
    for (int j = 0; j < r; ++j) {
      for (int i = 0; i < r; ++i) {
        float& value = field.at(i, j, k);
        value = std::max(value, -1.0f);
        if (value <= 0) continue;
        const Vec3 x = field.position(i, j, k);
        const auto nearest = std::min_element(sites.begin(), sites.end(), [&](auto& a, auto& b) {
          return (a - x).squaredNorm() < (b - x).squaredNorm();
        });
        for (const Vec3& site : sites) {
          if (&site == &*nearest) continue;
          const Vec3 across = site - *nearest;
          const double distance = ((site + *nearest) / 2 - x).dot(across) / across.norm();
          value = std::min(value, static_cast<float>(distance));
        }
      }
    }
  }
  return field;
}

const VoxelGrid<float>& field_at(int r) {
  static std::map<int, VoxelGrid<float>> fields;
  if (!fields.contains(r)) {
    fields.clear();  // one at a time, for the peak of memory
    fields.emplace(r, squirrel_in_pieces(r));
  }
  return fields.at(r);
}

double limit_ms(int r, bool parity) {
  switch (r) {
    case 64:
      return parity ? 45 : 20;
    case 128:
      return parity ? 400 : 150;
    default:
      return parity ? 5000 : 1500;
  }
}

/// Of all threads of this process: what a busy machine leaves comparable.
double cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

void segmentation(benchmark::State& state) {
  if (!std::filesystem::exists(kSquirrel)) return state.SkipWithError("no squirrel.obj");
  const auto r = static_cast<int>(state.range(0));
  const bool parity = state.range(1) != 0;
  const VoxelGrid<float>& field = field_at(r);
  reset_peak_memory();
  Segmentation result;
  double best = 1e9, best_cpu = 1e9;
  for (auto _ : state) {
    result = {};
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = cpu_ms();
    result = caged_sdf_segmentation(field, {.parity = parity});
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    best = std::min(best, time.count());
    best_cpu = std::min(best_cpu, cpu_ms() - cpu_start);
  }
  state.counters["min_ms"] = best;
  state.counters["min_cpu_ms"] = best_cpu;
  state.counters["limit_ms"] = limit_ms(r, parity);
  state.counters["peak_MB"] = static_cast<double>(peak_memory()) / 1e6;
  state.counters["labels"] = result.count;
  state.counters["mask_share"] =
      static_cast<double>(result.mask_voxels) / static_cast<double>(field.values.size());
  state.counters["dam_share"] =
      static_cast<double>(result.dam_voxels) / static_cast<double>(result.mask_voxels);
}

BENCHMARK(segmentation)
    ->ArgNames({"r", "parity"})
    ->ArgsProduct({{64, 128, 256}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(1)
    ->UseRealTime();

}  // namespace
}  // namespace fracbench
