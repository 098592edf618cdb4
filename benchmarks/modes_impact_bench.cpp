// The run time of the method modes on the paper's Squirrel (../shared/meshes/squirrel.obj; skipped
// where it is not there), and the cut that prepares it. The pieces are Voronoi regions in a block
// of tets around the shape instead of those of modes, so that their number is given: the run time
// depends on the pieces, not on where they come from.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/sum.h"
#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "methods/modes/model.h"
#include "source_folder.h"

namespace fracbench {
namespace {

using namespace modes;

const std::filesystem::path kSquirrel =
    std::filesystem::path(FRACBENCH_SOURCE_DIR) / "../shared/meshes/squirrel.obj";

/// n^3 cubes of six tets each around the shape; for n = 13 as many tets as a cage of 6000 faces.
TetMesh block_around(const TriangleMesh& shape, int n) {
  const UnitBox frame = unit_box(shape);
  std::vector<Vec3> vertices;
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        vertices.push_back(1.05 * (Vec3(i, j, k) / n - Vec3::Constant(0.5)));
      }
    }
  }
  std::vector<Tet> tets;
  for (int cube = 0; cube < n * n * n; ++cube) {
    std::array<int, 3> axes = {0, 1, 2};
    do {
      std::array<int, 3> at = {cube % n, cube / n % n, cube / (n * n)};
      Tet tet;
      for (int corner = 0; corner < 4; ++corner) {
        if (corner > 0) ++at[axes[corner - 1]];
        tet[corner] = at[0] + (n + 1) * (at[1] + (n + 1) * at[2]);
      }
      tets.push_back(tet);
    } while (std::ranges::next_permutation(axes).found);
  }
  return make_tet_mesh(std::move(vertices), std::move(tets), frame);
}

/// One mode whose pieces are Voronoi cells about points of the surface.
FractureModes voronoi_mode(const TriangleMesh& shape, const TetMesh& tets, int count) {
  Random random(1);
  std::vector<Vec3> sites;
  for (int n = 0; n < count; ++n) {
    const Face& face = shape.faces[random.below(shape.faces.size())];
    sites.push_back(tets.frame.to_unit(shape.vertices[face[0]]));
  }
  FractureModes found;
  found.dimension = 1;
  found.displacement.resize(static_cast<Eigen::Index>(tets.tets.size()), 1);
  found.energies = {1};
  std::vector<std::int32_t> pieces;
  for (std::size_t t = 0; t < tets.tets.size(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : tets.tets[t]) middle += tets.vertices[v] / 4;
    const auto nearest = std::ranges::min_element(
        sites, {}, [&](const Vec3& site) { return (site - middle).squaredNorm(); });
    pieces.push_back(static_cast<std::int32_t>(nearest - sites.begin()));
    found.displacement(static_cast<Eigen::Index>(t), 0) = pieces.back();
  }
  found.pieces = {pieces};
  found.piece_counts = {count};
  return found;
}

void cut(benchmark::State& state) {
  if (!std::filesystem::exists(kSquirrel)) return state.SkipWithError("no squirrel.obj");
  const Target target{"squirrel", normalized(read_mesh(kSquirrel), 1.9), {}};
  const TetMesh tets = block_around(target.mesh, 13);
  const FractureModes found = voronoi_mode(target.mesh, tets, static_cast<int>(state.range(0)));
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress};
  context.threads = static_cast<int>(state.range(1));
  std::size_t pieces = 0;
  for (auto _ : state) {
    pieces =
        atomic_pieces(target.mesh, tets, found, {.minimum_volume = 1e-4}, context).cut.cells.size();
  }
  state.counters["pieces"] = static_cast<double>(pieces);
}

void impact(benchmark::State& state) {
  if (!std::filesystem::exists(kSquirrel)) return state.SkipWithError("no squirrel.obj");
  const Target target{"squirrel", normalized(read_mesh(kSquirrel), 1.9), {}};
  const TetMesh tets = block_around(target.mesh, 13);
  const FractureModes found = voronoi_mode(target.mesh, tets, static_cast<int>(state.range(0)));
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress};
  AtomicPieces pieces = atomic_pieces(target.mesh, tets, found, {.minimum_volume = 1e-4}, context);
  ModelData data;
  data.projection = project_impacts(tets, pieces, context);
  data.typical_jump = typical_jump(data.projection, target.mesh, target.material.density);
  data.cut = std::move(pieces.cut);
  const auto model = std::make_shared<Model>(target, std::move(data), Strength{});
  const ModesBody body(model);

  Impulse impulse;
  impulse.point = target.mesh.corner(0, 0);
  impulse.direction = -area_vector2(target.mesh, 0).normalized();
  impulse.normal = -impulse.direction;
  impulse.magnitude = 4e4 * static_cast<double>(state.range(1));
  Impact impact;
  impact.impulses.push_back(impulse);
  impact.break_test = {.total_impulse = impulse.magnitude,
                       .balanced_force = impulse.magnitude * 250};
  StageTimer stages;
  Context run{random, stages, progress};
  run.threads = static_cast<int>(state.range(2));
  std::vector<Piece> broken;
  for (auto _ : state) broken = body.fracture(impact, run);
  Sum sum;
  std::size_t faces = 0;
  for (const Piece& piece : broken) {
    sum += volume(piece.mesh);
    faces += piece.mesh.faces.size();
  }
  state.counters["pieces"] = static_cast<double>(model->data().cut.cells.size());
  state.counters["fragments"] = static_cast<double>(broken.size());
  state.counters["faces"] = static_cast<double>(faces);
  state.counters["volume_error"] = sum.value() / volume(target.mesh) - 1;
  for (const auto& [name, seconds] : stages.times()) {
    state.counters[name + "_ms"] = 1e3 * seconds / static_cast<double>(state.iterations());
  }
}

// Pieces, threads.
BENCHMARK(cut)->Args({50, 1})->Args({50, 2})->Args({300, 2})->Unit(benchmark::kMillisecond);
// Pieces, impulse over the critical one, threads.
BENCHMARK(impact)
    ->Args({50, 1, 1})
    ->Args({50, 10, 1})
    ->Args({50, 10, 2})
    ->Args({300, 1000, 1})
    ->Args({300, 1000, 2})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fracbench
