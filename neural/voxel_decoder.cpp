#include "neural/voxel_decoder.h"

#include <cblas.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "neural/blas_threads.h"
#include "neural/normalise.h"

namespace fracbench::neural {

VoxelDecoder::VoxelDecoder(const Model& model)
    : network_(model.network), field_unit_(static_cast<float>(model.field_unit)) {
  linear_weight_ = model.weights.at("linear.weight");
  linear_bias_ = model.weights.at("linear.bias");
  const bool stored =
      network_.normalisation == Normalisation::batch && network_.statistics != Statistics::sample;
  for (const DecoderLayer& layer : decoder_blocks(network_)) {
    std::vector<float> weight = model.weights.at(layer.name + ".weight");
    std::vector<float> bias = model.weights.at(layer.name + ".bias");
    std::vector<float> scale = model.weights.at(layer.name + ".scale");
    std::vector<float> shift = model.weights.at(layer.name + ".shift");
    if (stored) {
      const auto mean = model.statistics.find(layer.name + ".mean");
      const auto variance = model.statistics.find(layer.name + ".variance");
      if (mean == model.statistics.end() || variance == model.statistics.end()) {
        throw InputError("the model has no statistics of its batch normalisation");
      }
      const std::size_t out = scale.size();
      for (std::size_t c = 0; c < out; ++c) {
        const float factor =
            scale[c] / static_cast<float>(std::sqrt(variance->second[c] + network_.epsilon));
        bias[c] = (bias[c] - mean->second[c]) * factor + shift[c];
        for (std::size_t ci = 0; ci < static_cast<std::size_t>(layer.in); ++ci) {
          for (std::size_t k = 0; k < 64; ++k) weight[(ci * out + c) * 64 + k] *= factor;
        }
      }
      scale.clear();
      shift.clear();
    }
    blocks_.push_back(
        {TransposedConvolution(layer, weight, bias), std::move(scale), std::move(shift)});
  }
  for (const DecoderLayer& layer : decoder_heads(network_)) {
    heads_.emplace_back(layer, model.weights.at(layer.name + ".weight"), std::span<const float>());
  }
}

void VoxelDecoder::finish(std::span<float> volume, const Block& block, int threads) const {
  if (block.scale.empty()) {
    leaky_relu(volume, static_cast<float>(network_.slope));
  } else {
    normalise(volume, {block.scale, block.shift}, network_, threads);
  }
}

VoxelGrid<float> VoxelDecoder::decode(const FieldSource& source, int resolution,
                                      int threads) const {
  require_resolution(network_, resolution);
  const std::span<const float> code = source.code;
  if (code.size() != static_cast<std::size_t>(network_.code_size())) {
    throw InputError(
        fmt::format("a code has {} values, must have {}", code.size(), network_.code_size()));
  }
  openblas_set_num_threads(threads);
  Volume volume(linear_bias_.begin(), linear_bias_.end());
  // A channel at a time: OpenBLAS sums in another order for another number of threads.
  constexpr std::size_t kRows = kBaseSide * kBaseSide * kBaseSide;
  on_blas_threads(volume.size() / kRows, threads, [&](std::size_t channel, std::size_t) {
    cblas_sgemv(CblasRowMajor, CblasNoTrans, kRows, static_cast<int>(code.size()), 1.0f,
                linear_weight_.data() + channel * kRows * code.size(),
                static_cast<int>(code.size()), code.data(), 1, 1.0f,
                volume.data() + channel * kRows, 1);
  });
  leaky_relu(volume, static_cast<float>(network_.slope));
  const auto layers = decoder_blocks(network_);
  for (std::size_t k = 0; k < layers.size() && 4 * layers[k].side <= resolution; ++k) {
    volume = blocks_[k].convolution(volume, threads);
    finish(volume, blocks_[k], threads);
  }
  VoxelGrid<float> field = unit_grid<float>(resolution);
  const auto head = static_cast<std::size_t>(std::ranges::find(network_.resolutions, resolution) -
                                             network_.resolutions.begin());
  volume = heads_[head](volume, threads);
  const std::size_t plane = volume.size() / static_cast<std::size_t>(resolution);
  on_blas_threads(static_cast<std::size_t>(resolution), threads, [&](std::size_t z, std::size_t) {
    for (std::size_t k = z * plane; k < (z + 1) * plane; ++k) {
      field.values[k] = field_unit_ * std::tanh(volume[k]);
    }
  });
  return field;
}

}  // namespace fracbench::neural
