// Elastostatics of the method bem: assembly and factorisation of a body's matrix, growth with the
// number of triangles, and the rate of the factorisation beside that of a matrix product (dgemm) in
// the same program. CPU times are of all threads; the argument is the number of triangles, then
// that of threads.

#include <benchmark/benchmark.h>
#include <cblas.h>

#include <Eigen/Core>
#include <chrono>

#include "core/peak_memory.h"
#include "methods/bem/body_stress.h"
#include "methods/bem/elastic_body.h"
#include "methods/bem/elastic_operator.h"
#include "methods/bem/validation/smooth_bodies.h"

namespace fracbench::bem {
namespace {

// About as many triangles as asked for: 12 cells^2.
TriangleMesh cube_of(std::int64_t triangles) {
  return cube_surface(
      static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 12))));
}

struct Workbench {
  Random random{1};
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress};
  explicit Workbench(std::int64_t threads) { context.threads = static_cast<int>(threads); }
};

// Floating point operations per second of a product of square matrices as large as `unknowns`, at
// most 2000.
double dgemm_rate(Eigen::Index unknowns, int threads) {
  const int n = static_cast<int>(std::min<Eigen::Index>(unknowns, 2000));
  const Eigen::MatrixXd a = Eigen::MatrixXd::Constant(n, n, 1.5);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Constant(n, n, 0.5);
  Eigen::MatrixXd c(n, n);
  openblas_set_num_threads(threads);
  double best = 1e300;
  for (int k = 0; k < 3; ++k) {
    const auto start = std::chrono::steady_clock::now();
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, n, n, 1, a.data(), n, b.data(), n, 0,
                c.data(), n);
    best = std::min(
        best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 2.0 * n * n * n / best;
}

void assemble_and_factorise(benchmark::State& state) {
  const TriangleMesh mesh = cube_of(state.range(0));
  Workbench bench(state.range(1));
  reset_peak_memory();
  Eigen::Index unknowns = 0;
  for (auto _ : state) {
    const ElasticBody body(mesh, {}, bench.context);
    unknowns = body.rigid_motions().rows();
  }
  const auto runs = static_cast<double>(state.iterations());
  double factor_seconds = 0;
  for (const StageTime& time : bench.timer.times()) {
    state.counters[time.name + "_s"] = time.seconds / runs;
    if (time.name == "factorise") factor_seconds = time.seconds / runs;
  }
  const double n = static_cast<double>(unknowns);
  const double rate = n * n * n / 3 / factor_seconds;
  state.counters["triangles"] = static_cast<double>(mesh.faces.size());
  state.counters["peak_MB"] = 1e-6 * static_cast<double>(peak_memory());
  state.counters["predicted_MB"] =
      1e-6 * static_cast<double>(predict_cost(mesh.faces.size()).bytes);
  state.counters["predicted_s"] = predict_cost(mesh.faces.size()).seconds(bench.context.threads);
  state.counters["factor_Gflops"] = 1e-9 * rate;
  state.counters["share_of_dgemm"] = rate / dgemm_rate(unknowns, bench.context.threads);
}
BENCHMARK(assemble_and_factorise)
    ->ArgsProduct({{400, 1500, 3000, 6000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

void solve_one_load(benchmark::State& state) {
  Workbench bench(state.range(1));
  const ElasticBody body(cube_of(state.range(0)), {}, bench.context);
  Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, body.elements().size());
  tractions.col(3) = Vec3(0, 0, 1e6);
  const BalancedLoad load =
      balance_load(body.elements(), tractions, {}, LoadBalance::inertia_relief);
  for (auto _ : state) benchmark::DoNotOptimize(BodyStress(body, load, bench.context));
}
BENCHMARK(solve_one_load)
    ->ArgsProduct({{400, 1500, 6000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

// Time per point, on one thread.
void stress_inside(benchmark::State& state) {
  Workbench bench(2);
  const ElasticBody body(cube_of(state.range(0)), {}, bench.context);
  Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, body.elements().size());
  tractions.col(3) = Vec3(0, 0, 1e6);
  const BodyStress stress(body, balance_load(body.elements(), tractions, {}, LoadBalance::min_norm),
                          bench.context);
  int k = 0;
  for (auto _ : state) {
    k = (k + 1) % 1000;
    benchmark::DoNotOptimize(stress.at({0.1 + 0.0008 * k, 0.2 + 0.0003 * k, 0.6}));
  }
}
BENCHMARK(stress_inside)->Arg(400)->Arg(1500)->Arg(6000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace fracbench::bem
