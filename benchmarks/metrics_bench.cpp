// All metrics of one cell: a shape broken by `cvd` into about 30 fragments, and what else looks at
// such fragments. `squirrel` where ../shared/meshes has it, else the generated chair.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "geometry/measures.h"
#include "geometry/overlap.h"
#include "geometry/read_mesh.h"
#include "geometry/tag_surfaces.h"
#include "methods/registry.h"
#include "metrics/registry.h"
#include "scenarios/given_impact.h"
#include "scenarios/replacement.h"
#include "scenarios/shapes.h"
#include "source_folder.h"

namespace {

using namespace fracbench;

struct BrokenCell {
  TriangleMesh body;
  Fragments fragments;
  std::vector<Impact> impacts;
  std::size_t faces = 0;
};

BrokenCell break_shape() {
  const std::string squirrel = FRACBENCH_SOURCE_DIR "/../shared/meshes/squirrel.obj";
  const bool there = std::filesystem::exists(squirrel);
  const TriangleMesh mesh =
      there ? normalized(read_mesh(squirrel), 1.9) : load_shape({.name = "chair"}).mesh;
  const Target target{.name = "body", .mesh = mesh, .material = {}};
  BrokenCell cell{.body = target.mesh, .fragments = {}, .impacts = {}};
  cell.impacts.push_back(impact_at(target, target.mesh.vertices[0], {1, 0, 0}, 1e5));

  const Method& cvd = find_method("cvd");
  const Options options(cvd.options(), {{"sites", std::int64_t{30}}}, "cvd");
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{.random = random, .timer = timer, .progress = progress, .threads = 2};
  const auto breakable = cvd.prepare(target, {}, options, context);
  std::vector<Piece> pieces = breakable->fracture(cell.impacts[0], context);

  std::vector<FragmentFace> own(target.mesh.faces.size());
  for (std::size_t f = 0; f < own.size(); ++f) own[f].original_face = static_cast<std::int32_t>(f);
  std::int32_t next_interface = 0;
  const auto tags = compose_faces(own, pieces, next_interface);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    cell.fragments.push_back({.mesh = std::move(pieces[i].mesh), .faces = tags[i]});
    cell.faces += tags[i].size();
  }
  return cell;
}

const BrokenCell& broken_cell() {
  static const BrokenCell cell = break_shape();
  return cell;
}

void set_counters(benchmark::State& state) {
  state.counters["fragments"] = static_cast<double>(broken_cell().fragments.size());
  state.counters["faces"] = static_cast<double>(broken_cell().faces);
}

CellResult result(int threads) {
  const BrokenCell& cell = broken_cell();
  return {.body = cell.body,
          .fragments = cell.fragments,
          .impacts = cell.impacts,
          .stages = {},
          .threads = threads};
}

void all_metrics(benchmark::State& state) {
  const CellResult cell = result(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    for (const auto& metric : metrics()) benchmark::DoNotOptimize(metric->measure(cell));
  }
  set_counters(state);
}
BENCHMARK(all_metrics)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void one_metric(benchmark::State& state) {
  const Metric& metric = *metrics().at(state.range(0));
  const CellResult cell = result(1);
  for (auto _ : state) benchmark::DoNotOptimize(metric.measure(cell));
  state.SetLabel(metric.info().name);
}
BENCHMARK(one_metric)->DenseRange(0, 7)->Unit(benchmark::kMillisecond);

void overlaps(benchmark::State& state) {
  std::vector<std::reference_wrapper<const TriangleMesh>> solids;
  for (const Fragment& fragment : broken_cell().fragments) solids.emplace_back(fragment.mesh);
  for (auto _ : state) benchmark::DoNotOptimize(find_overlaps(solids, {.threads = 1}));
}
BENCHMARK(overlaps)->Unit(benchmark::kMillisecond);

void tags(benchmark::State& state) {
  std::vector<TriangleMesh> meshes;
  for (const Fragment& fragment : broken_cell().fragments) meshes.push_back(fragment.mesh);
  for (auto _ : state) benchmark::DoNotOptimize(tag_fragments(broken_cell().body, meshes));
}
BENCHMARK(tags)->Unit(benchmark::kMillisecond);

}  // namespace
