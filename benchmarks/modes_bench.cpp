// The preparation of the method modes up to its modes: the reference shapes of about 2000 tets, and
// the paper's settings on Squirrel (../shared/meshes/squirrel.obj; skipped where it is not there).
// What users wait for is real time; on a loaded machine the CPU column is the one to read.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>

#include "core/peak_memory.h"
#include "geometry/read_mesh.h"
#include "methods/modes/cage.h"
#include "methods/modes/fracture_modes.h"
#include "methods/modes/validation/shapes.h"
#include "source_folder.h"

namespace fracbench::modes {
namespace {

const std::filesystem::path kSquirrel =
    std::filesystem::path(FRACBENCH_SOURCE_DIR) / "../shared/meshes/squirrel.obj";

struct Surroundings {
  Random random{1};
  StageTimer timer;
  Progress progress;
  Context context{.random = random, .timer = timer, .progress = progress};
};

void add_facts(benchmark::State& state, const TetMesh& mesh, const FractureModes& modes) {
  state.counters["tets"] = static_cast<double>(mesh.tets.size());
  state.counters["gap"] = *std::ranges::max_element(modes.gaps);
  state.counters["peak_MB"] = static_cast<double>(peak_memory()) / (1 << 20);
}

/// Tets and modes of the notched bar: count, dimension, tets.
void notched_bar_modes(benchmark::State& state) {
  reset_peak_memory();
  for (auto _ : state) {
    Surroundings s;
    const TetMesh mesh =
        tetrahedralise_cage(notched_bar(), {.target_tets = state.range(2)}, s.context);
    const FractureModes modes = compute_modes(
        mesh,
        {.count = static_cast<int>(state.range(0)), .dimension = static_cast<int>(state.range(1))},
        s.context);
    add_facts(state, mesh, modes);
  }
}

/// Cage and tets of Squirrel: cage faces.
void squirrel_cage(benchmark::State& state) {
  if (!std::filesystem::exists(kSquirrel)) return state.SkipWithError("no squirrel.obj");
  const TriangleMesh shape = read_mesh(kSquirrel);
  for (auto _ : state) {
    Surroundings s;
    const TetMesh mesh = tetrahedralise_cage(shape, {.target_faces = state.range(0)}, s.context);
    state.counters["tets"] = static_cast<double>(mesh.tets.size());
  }
}

/// Modes of Squirrel: count, dimension, cage faces.
void squirrel_modes(benchmark::State& state) {
  if (!std::filesystem::exists(kSquirrel)) return state.SkipWithError("no squirrel.obj");
  Surroundings s;
  const TetMesh mesh =
      tetrahedralise_cage(read_mesh(kSquirrel), {.target_faces = state.range(2)}, s.context);
  reset_peak_memory();
  for (auto _ : state) {
    const FractureModes modes = compute_modes(
        mesh,
        {.count = static_cast<int>(state.range(0)), .dimension = static_cast<int>(state.range(1))},
        s.context);
    add_facts(state, mesh, modes);
  }
}

BENCHMARK(notched_bar_modes)
    ->ArgNames({"modes", "d", "tets"})
    ->Args({10, 1, 2000})
    ->Args({6, 3, 1605})
    ->Unit(benchmark::kSecond);
BENCHMARK(squirrel_cage)
    ->ArgName("faces")
    ->Arg(kPaperCage.cage_faces)
    ->Arg(kPaperFineCage.cage_faces)
    ->Unit(benchmark::kSecond);
BENCHMARK(squirrel_modes)
    ->ArgNames({"modes", "d", "faces"})
    ->Args({30, 3, kPaperCage.cage_faces})
    ->Args({30, 1, kPaperCage.cage_faces})
    ->Args({10, 3, kPaperFineCage.cage_faces})
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace fracbench::modes
