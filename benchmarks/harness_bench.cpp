// What the harness costs beyond methods and scenes. The budget is 20 ms per cell: plan, claim,
// record (two fsyncs: the file and its folder) and bookkeeping together, see RunPerCell; with
// worker processes RunInWorkersPerCell, their start included, and AskWarmWorker for the way there
// and back alone. This program is its own worker.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <string_view>

#include "core/freed_memory.h"
#include "core/random.h"
#include "harness/data_file.h"
#include "harness/plan.h"
#include "harness/record.h"
#include "harness/record_store.h"
#include "harness/runner.h"
#include "harness/suite_reader.h"
#include "harness/summaries.h"
#include "harness/workers/serve_cells.h"
#include "harness/workers/worker_pool.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

constexpr int kCells = 40;

Suite bench_suite(const Catalog& catalog, int count) {
  return parse_suite("shapes = [\"cube\"]\n[[scenario]]\nfamily = \"single\"\ncount = " +
                         std::to_string(count) + "\n[[method]]\nname = \"cvd\"\n",
                     "bench.toml", catalog);
}

/// As large as the record of a pot in 20 pieces after 200 frames: half a megabyte on disk.
Record typical_record() {
  Random random(1);
  Record record;
  record.key = std::string(64, '0');
  record.identity.shape = "cube";
  record.identity.label = "cvd";
  SceneResult& scene = record.outcome.scene;
  scene.impacts.emplace_back();
  scene.trajectory.frame_seconds = 1.0 / 250;
  for (std::int32_t f = 0; f < 20; ++f) {
    Fragment fragment{.mesh = {}, .faces = {}, .piece = f};
    for (int v = 0; v < 500; ++v) fragment.mesh.vertices.push_back(random.unit_vector());
    for (std::int32_t k = 0; k < 1000; ++k) {
      fragment.mesh.faces.push_back({k % 500, (k + 1) % 500, (k + 7) % 500});
      fragment.faces.push_back({k, k % 20});
    }
    scene.fragments.push_back(std::move(fragment));
    Track track{Track::Kind::piece, f, 0, std::vector<Pose>(200)};
    for (Pose& pose : track.poses) pose.position = random.unit_vector();
    scene.trajectory.tracks.push_back(std::move(track));
  }
  for (int m = 0; m < 30; ++m) {
    record.outcome.measurement.values.push_back({"metric_" + std::to_string(m), 0.1 * m, "m"});
  }
  record.cost.total_seconds = 1;
  return record;
}

class Folder {
 public:
  Folder() : path_(fs::current_path() / "harness_bench_results") { fs::remove_all(path_); }
  ~Folder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Time over the number of cells in an iteration.
benchmark::Counter per_cell(double cells) {
  return {cells, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

void PlanPerCell(benchmark::State& state) {
  const Catalog catalog = built_in_catalog();
  const Suite suite = bench_suite(catalog, 1000);
  for (auto _ : state) benchmark::DoNotOptimize(make_plan(suite, catalog));
  state.counters["per_cell"] = per_cell(1000);
}
BENCHMARK(PlanPerCell)->Unit(benchmark::kMillisecond);

void EncodeRecord(benchmark::State& state) {
  const Record record = typical_record();
  std::size_t size = 0;
  for (auto _ : state) {
    const std::string bytes = to_hdf5(to_tree(record), is_packed_array);
    size = bytes.size();
  }
  state.counters["bytes"] = static_cast<double>(size);
}
BENCHMARK(EncodeRecord)->Unit(benchmark::kMillisecond);

void WriteRecord(benchmark::State& state) {
  const Folder folder;
  const RecordStore store(folder.path());
  const Record record = typical_record();
  for (auto _ : state) {
    const auto claim = store.claim(record.key);
    store.write(*claim, record);
  }
}
BENCHMARK(WriteRecord)->Unit(benchmark::kMillisecond)->UseRealTime();

void ReadAndVerifyRecord(benchmark::State& state) {
  const Folder folder;
  const RecordStore store(folder.path());
  const Record record = typical_record();
  store.write(*store.claim(record.key), record);
  for (auto _ : state) benchmark::DoNotOptimize(store.read(record.key));
}
BENCHMARK(ReadAndVerifyRecord)->Unit(benchmark::kMillisecond);

void ReadSummary(benchmark::State& state) {
  const Folder folder;
  const RecordStore store(folder.path());
  const Record record = typical_record();
  store.write(*store.claim(record.key), record);
  const fs::path file = store.record_file(record.key);
  for (auto _ : state) benchmark::DoNotOptimize(to_summary(read_hdf5(file, is_summary_array)));
}
BENCHMARK(ReadSummary)->Unit(benchmark::kMillisecond);

/// Everything from the suite's text to the last record on disk, with records that cost nothing.
void RunPerCell(benchmark::State& state) {
  const Catalog catalog = built_in_catalog();
  const Record record = typical_record();
  for (auto _ : state) {
    state.PauseTiming();
    const Folder folder;
    state.ResumeTiming();
    const Plan plan = make_plan(bench_suite(catalog, kCells), catalog);
    run_suite(plan, catalog,
              {.folder = folder.path(),
               .jobs = static_cast<int>(state.range(0)),
               .execute = [&](const Cell& cell, Progress&, const std::stop_token&) {
                 Record copy = record;
                 copy.key = cell.key;
                 return copy;
               }});
  }
  state.counters["per_cell"] = per_cell(kCells);
}
BENCHMARK(RunPerCell)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// Scenes that cost nothing and give a typical record.
Catalog instant_catalog() {
  Catalog catalog = built_in_catalog();
  catalog.metrics = {};
  catalog.run_scene = [](auto&&...) {
    static const SceneResult result = typical_record().outcome.scene;
    return result;
  };
  return catalog;
}

void AskWarmWorker(benchmark::State& state) {
  const Catalog catalog = instant_catalog();
  const Plan plan = make_plan(bench_suite(catalog, 1), catalog);
  WorkerPool pool(plan, catalog, {});
  Progress progress;
  pool.execute(plan.cells[0], progress, {});
  for (auto _ : state) {
    const Record record = pool.execute(plan.cells[0], progress, {});
    if (record.outcome.status != CellStatus::ok) state.SkipWithError(record.outcome.reason.c_str());
  }
}
BENCHMARK(AskWarmWorker)->Unit(benchmark::kMillisecond)->UseRealTime();

void StartWorker(benchmark::State& state) {
  const Catalog catalog = instant_catalog();
  const Plan plan = make_plan(bench_suite(catalog, 1), catalog);
  Progress progress;
  for (auto _ : state) WorkerPool(plan, catalog, {}).execute(plan.cells[0], progress, {});
}
BENCHMARK(StartWorker)->Unit(benchmark::kMillisecond)->UseRealTime();

void RunInWorkersPerCell(benchmark::State& state) {
  const Catalog catalog = instant_catalog();
  for (auto _ : state) {
    state.PauseTiming();
    const Folder folder;
    state.ResumeTiming();
    const Plan plan = make_plan(bench_suite(catalog, kCells), catalog);
    WorkerPool pool(plan, catalog, {});
    run_suite(plan, catalog,
              {.folder = folder.path(),
               .jobs = static_cast<int>(state.range(0)),
               .execute = [&](const Cell& cell, Progress& progress, const std::stop_token& stop) {
                 return pool.execute(cell, progress, stop);
               }});
  }
  state.counters["per_cell"] = per_cell(kCells);
}
BENCHMARK(RunInWorkersPerCell)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace fracbench

int main(int argc, char** argv) {
  fracbench::keep_freed_memory();  // as the program does
  if (argc == 2 && std::string_view(argv[1]) == "worker") {
    return fracbench::serve_cells(fracbench::instant_catalog());
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
