#include "neural/normalise.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "neural/blas_threads.h"

namespace fracbench::neural {

namespace {

constexpr std::size_t kGroups = 8;

/// Mean and one over the deviation of all values.
std::pair<float, float> statistics_of(std::span<const float> values, double epsilon) {
  const double count = static_cast<double>(values.size());
  // Row by row in single precision, which the compiler makes vectors of, rows in double.
  constexpr std::size_t kRow = 256;
  const auto sum_of = [&](auto term) {
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); k += kRow) {
      float parts[8] = {};
      const std::size_t end = std::min(k + kRow, values.size());
      std::size_t at = k;
      for (; at + 8 <= end; at += 8) {
        for (std::size_t p = 0; p < 8; ++p) parts[p] += term(values[at + p]);
      }
      for (; at < end; ++at) parts[0] += term(values[at]);
      for (const float part : parts) sum += part;
    }
    return sum;
  };
  const auto mean = static_cast<float>(sum_of([](float v) { return v; }) / count);
  const double variance = sum_of([mean](float v) { return (v - mean) * (v - mean); }) / count;
  return {mean, static_cast<float>(1 / std::sqrt(variance + epsilon))};
}

}  // namespace

void leaky_relu(std::span<float> values, float slope) {
  for (float& v : values) v = v > 0 ? v : slope * v;
}

void normalise(std::span<float> volume, const NormalisationWeights& weights,
               const NetworkOptions& network, int threads) {
  const auto slope = static_cast<float>(network.slope);
  const std::size_t channels = weights.scale.size();
  const std::size_t voxels = volume.size() / channels;
  const std::size_t groups = network.normalisation == Normalisation::group ? kGroups : channels;
  const std::size_t each = channels / groups;
  on_blas_threads(groups, threads, [&](std::size_t g, std::size_t) {
    const std::span values = volume.subspan(g * each * voxels, each * voxels);
    const auto [mean, inverse] = statistics_of(values, network.epsilon);
    for (std::size_t c = 0; c < each; ++c) {
      const float scale = weights.scale[g * each + c] * inverse;
      const float shift = weights.shift[g * each + c] - mean * scale;
      for (float& v : values.subspan(c * voxels, voxels)) {
        const float w = v * scale + shift;
        v = w > 0 ? w : slope * w;
      }
    }
  });
}

}  // namespace fracbench::neural
