// partition_by_labels: the Squirrel (FRACBENCH_BENCH_MESH, else ../shared/meshes/squirrel.obj
// beside the checkout, else a generated sphere with as many faces) cut into 20 Voronoi regions.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <vector>

#include "core/peak_memory.h"
#include "core/random.h"
#include "geometry/measures.h"
#include "geometry/partition_by_labels.h"
#include "geometry/read_mesh.h"
#include "geometry/surface_distance.h"

namespace {

using namespace fracbench;

TriangleMesh sphere(int stacks, int slices, double radius) {
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0, 0, radius);
  for (int i = 1; i < stacks; ++i) {
    const double theta = std::numbers::pi * i / stacks;
    for (int j = 0; j < slices; ++j) {
      const double phi = 2 * std::numbers::pi * j / slices;
      mesh.vertices.push_back(radius * Vec3(std::sin(theta) * std::cos(phi),
                                            std::sin(theta) * std::sin(phi), std::cos(theta)));
    }
  }
  mesh.vertices.emplace_back(0, 0, -radius);
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

const TriangleMesh& body() {
  static const TriangleMesh mesh = [] {
    const char* given = std::getenv("FRACBENCH_BENCH_MESH");
    const std::filesystem::path file = given ? given : "../shared/meshes/squirrel.obj";
    if (std::filesystem::exists(file)) return normalized(read_mesh(file), 1.9);
    return sphere(94, 94, 0.95);
  }();
  return mesh;
}

const std::vector<Vec3>& sites() {
  static const std::vector<Vec3> points = [] {
    Random random(20251);
    const SurfaceDistance surface(body());
    const BoundingBox box = bounding_box(body());
    std::vector<Vec3> result;
    while (result.size() < 20) {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = random.uniform(box.low[axis], box.high[axis]);
      if (surface.inside(p)) result.push_back(p);
    }
    return result;
  }();
  return points;
}

VoxelGrid<std::int32_t> voronoi(int r) {
  auto grid = unit_grid<std::int32_t>(r);
  for (int k = 0; k < r; ++k) {
    for (int j = 0; j < r; ++j) {
      for (int i = 0; i < r; ++i) {
        const Vec3 p = grid.position(i, j, k);
        std::size_t best = 0;
        for (std::size_t s = 1; s < sites().size(); ++s) {
          if ((p - sites()[s]).squaredNorm() < (p - sites()[best]).squaredNorm()) best = s;
        }
        grid.at(i, j, k) = static_cast<std::int32_t>(best) + 1;
      }
    }
  }
  return grid;
}

void run(benchmark::State& state, PartitionPath path) {
  const auto labels = voronoi(static_cast<int>(state.range(0)));
  reset_peak_memory();
  std::size_t pieces = 0, faces = 0;
  for (auto _ : state) {
    const Partition partition = partition_by_labels(body(), labels, {.path = path});
    pieces = partition.pieces.size();
    faces = 0;
    for (const Piece& piece : partition.pieces) faces += piece.mesh.faces.size();
  }
  state.counters["pieces"] = static_cast<double>(pieces);
  state.counters["faces"] = static_cast<double>(faces);
  state.counters["peak_MB"] = static_cast<double>(peak_memory()) / 1e6;
}

void fast(benchmark::State& state) { run(state, PartitionPath::fast); }
void exact(benchmark::State& state) { run(state, PartitionPath::exact); }

BENCHMARK(fast)
    ->Arg(64)
    ->Arg(128)
    ->Arg(256)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK(exact)
    ->Arg(64)
    ->Arg(128)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
