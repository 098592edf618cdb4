// Prediction of a field by the code-to-voxel decoder, beside the machine's rate for matrix products
// in single precision. Weights are random: they do not change the work.

#include <benchmark/benchmark.h>
#include <cblas.h>

#include <cmath>

#include "core/peak_memory.h"
#include "core/random.h"
#include "neural/model.h"
#include "neural/operations.h"
#include "neural/voxel_decoder.h"

namespace {

using namespace fracbench;

constexpr double kGiga = 1e9;

neural::Model random_model(const neural::NetworkOptions& network) {
  neural::Model model;
  model.network = network;
  Random random(1);
  for (const neural::WeightSpec& spec : neural::weight_specs(network)) {
    std::vector<float>& values = model.weights[spec.name];
    values.resize(spec.size());
    for (float& value : values) value = static_cast<float>(random.uniform(-0.05, 0.05));
  }
  return model;
}

/// The rate of a product whose operands fit the processor's caches as well as can be.
void Sgemm(benchmark::State& state) {
  const int n = 2048, threads = static_cast<int>(state.range(0));
  openblas_set_num_threads(threads);
  std::vector<float> a(static_cast<std::size_t>(n) * n, 0.5f), b = a, c(a.size());
  for (auto _ : state) {
    cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, n, n, n, 1.0f, a.data(), n, b.data(), n,
                0.0f, c.data(), n);
    benchmark::DoNotOptimize(c.data());
  }
  state.counters["Gflop/s"] = benchmark::Counter(2.0 * std::pow(n, 3) / kGiga,
                                                 benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(Sgemm)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void Predict(benchmark::State& state) {
  const int r = static_cast<int>(state.range(0)), threads = static_cast<int>(state.range(2));
  const neural::Model model =
      random_model({.resolutions = {r}, .width = static_cast<double>(state.range(1)) / 16});
  const neural::VoxelDecoder decoder(model);
  const std::vector<float> code(static_cast<std::size_t>(model.network.code_size()), 0.3f);
  reset_peak_memory();
  for (auto _ : state) {
    benchmark::DoNotOptimize(decoder.decode({code, {}}, r, threads).values.data());
  }
  state.counters["Gflop/s"] =
      benchmark::Counter(neural::decoding_operations(model.network, r) / kGiga,
                         benchmark::Counter::kIsIterationInvariantRate);
  state.counters["peak_MB"] = static_cast<double>(peak_memory()) / 1e6;
}
BENCHMARK(Predict)
    ->ArgNames({"r", "sixteenths", "threads"})
    ->Args({32, 16, 2})
    ->Args({64, 16, 2})
    ->Args({128, 16, 1})
    ->Args({128, 16, 2})
    ->Args({256, 16, 2})
    ->Args({64, 4, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
