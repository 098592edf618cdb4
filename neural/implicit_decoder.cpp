#include "neural/implicit_decoder.h"

#include <cblas.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace fracbench::neural {

namespace {

// Places that go through the layers together: their values stay in the processor's caches.
constexpr std::size_t kBatch = 2048;

}  // namespace

VoxelGrid<float> ImplicitDecoder::decode(const FieldSource& source, int resolution,
                                         int threads) const {
  const NetworkOptions& network = model_.network;
  require_resolution(network, resolution);
  const auto code = static_cast<std::size_t>(network.code_size());
  if (source.code.size() != code) {
    throw InputError(fmt::format("a code has {} values, must have {}", source.code.size(), code));
  }
  openblas_set_num_threads(threads);
  const auto unit = static_cast<float>(model_.field_unit);
  const auto hidden = static_cast<std::size_t>(hidden_values(network));
  VoxelGrid<float> field = unit_grid<float>(resolution);
  const std::size_t input = code + 3, wide = hidden + input;
  std::vector<float> inputs(kBatch * input), from(kBatch * wide), to(kBatch * wide);
  for (std::size_t first = 0; first < field.values.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, field.values.size() - first);
    for (std::size_t n = 0; n < count; ++n) {
      const auto voxel = static_cast<int>(first + n);
      const Vec3 p = field.position(voxel % resolution, voxel / resolution % resolution,
                                    voxel / (resolution * resolution));
      float* row = &inputs[n * input];
      std::ranges::copy(source.code, row);
      for (int c = 0; c < 3; ++c)
        row[code + static_cast<std::size_t>(c)] = static_cast<float>(p[c]);
      std::copy_n(row, input, &from[n * wide]);
    }
    for (int k = 0; k <= kHiddenLayers; ++k) {
      const std::vector<float>& weight = model_.weights.at(fmt::format("layer{}.weight", k));
      const std::vector<float>& bias = model_.weights.at(fmt::format("layer{}.bias", k));
      const std::size_t rows = bias.size(), columns = weight.size() / rows;
      for (std::size_t n = 0; n < count; ++n) std::ranges::copy(bias, &to[n * wide]);
      cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasTrans, static_cast<int>(count),
                  static_cast<int>(rows), static_cast<int>(columns), 1.0f, from.data(),
                  static_cast<int>(wide), weight.data(), static_cast<int>(columns), 1.0f, to.data(),
                  static_cast<int>(wide));
      std::swap(from, to);
      if (k == kHiddenLayers) break;
      for (std::size_t n = 0; n < count; ++n) {
        float* row = &from[n * wide];
        for (std::size_t c = 0; c < rows; ++c) row[c] = std::max(row[c], 0.0f);
        if (k + 1 == kSkipLayer) std::copy_n(&inputs[n * input], input, row + rows);
      }
    }
    for (std::size_t n = 0; n < count; ++n) {
      field.values[first + n] = unit * std::tanh(from[n * wide]);
    }
  }
  return field;
}

}  // namespace fracbench::neural
