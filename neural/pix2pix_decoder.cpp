#include "neural/pix2pix_decoder.h"

#include <cblas.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "neural/normalise.h"
#include "neural/transposed_convolution.h"

namespace fracbench::neural {

namespace {

constexpr int kKernel = 4, kTaps = kKernel * kKernel * kKernel;

std::size_t cube(int side) { return static_cast<std::size_t>(side) * side * side; }

/// Convolution of kernel 4, stride 2, padding 1: [in][side^3] to [out][(side / 2)^3]. `weight` is
/// [out][in][4][4][4].
Volume convolution(std::span<const float> input, int side, int in, int out,
                   const std::vector<float>& weight, const std::vector<float>& bias) {
  const int half = side / 2;
  const std::size_t plane = static_cast<std::size_t>(half) * half;
  const std::size_t rows = static_cast<std::size_t>(in) * kTaps;
  Volume columns(rows * plane), output(static_cast<std::size_t>(out) * cube(half));
  for (int z = 0; z < half; ++z) {
    for (std::size_t row = 0; row < rows; ++row) {
      const int tap = static_cast<int>(row % kTaps);
      const int kz = tap / 16, ky = tap / 4 % 4, kx = tap % 4, iz = 2 * z - 1 + kz;
      const float* volume = &input[row / kTaps * cube(side)];
      float* to = &columns[row * plane];
      for (int y = 0; y < half; ++y) {
        const int iy = 2 * y - 1 + ky;
        for (int x = 0; x < half; ++x) {
          const int ix = 2 * x - 1 + kx;
          const bool inside = iz >= 0 && iz < side && iy >= 0 && iy < side && ix >= 0 && ix < side;
          to[y * half + x] =
              inside ? volume[(static_cast<std::size_t>(iz) * side + iy) * side + ix] : 0.0f;
        }
      }
    }
    float* values = &output[static_cast<std::size_t>(z) * plane];
    const auto stride = static_cast<int>(cube(half));
    for (int c = 0; c < out; ++c) {
      std::fill_n(values + static_cast<std::size_t>(c) * cube(half), plane,
                  bias[static_cast<std::size_t>(c)]);
    }
    cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, out, static_cast<int>(plane),
                static_cast<int>(rows), 1.0f, weight.data(), static_cast<int>(rows), columns.data(),
                static_cast<int>(plane), 1.0f, values, stride);
  }
  return output;
}

}  // namespace

std::vector<float> impulse_volume(std::span<const float> impulses, const ImpulseScaling& scaling,
                                  int resolution) {
  std::vector<float> volume(cube(resolution), 0.0f);
  for (std::size_t at = 0; at + kImpulseValues <= impulses.size(); at += kImpulseValues) {
    std::size_t index = 0;
    for (int c = 2; c >= 0; --c) {
      const double x =
          impulses[at + static_cast<std::size_t>(c)] * scaling.half_side + scaling.centre[c];
      const int voxel =
          std::clamp(static_cast<int>(std::floor((x + 1) / 2 * resolution)), 0, resolution - 1);
      index = index * static_cast<std::size_t>(resolution) + static_cast<std::size_t>(voxel);
    }
    volume[index] += 1 + impulses[at + 6];
  }
  return volume;
}

VoxelGrid<float> Pix2pixDecoder::decode(const FieldSource& source, int resolution,
                                        int threads) const {
  const NetworkOptions& network = model_.network;
  require_resolution(network, resolution);
  if (source.impulses.size() != static_cast<std::size_t>(network.features * kImpulseValues)) {
    throw InputError(fmt::format("the model takes {} impulses, {} values were given",
                                 network.features, source.impulses.size()));
  }
  openblas_set_num_threads(threads);
  const auto weight = [&](int k, const char* way, const char* what) -> const std::vector<float>& {
    return model_.weights.at(fmt::format("{}{}.{}", way, k, what));
  };
  const auto unit = static_cast<float>(model_.field_unit);
  const std::vector<int> channels = unet_channels(network);
  const auto depth = static_cast<int>(channels.size());
  std::vector<Volume> levels;
  const auto impulses = impulse_volume(source.impulses, model_.shapes.front().scaling, resolution);
  Volume volume(impulses.begin(), impulses.end());
  for (int k = 0, side = resolution; k < depth; ++k, side /= 2) {
    volume = convolution(volume, side, k == 0 ? 1 : channels[k - 1], channels[k],
                         weight(k, "down", "weight"), weight(k, "down", "bias"));
    if (k > 0) {
      normalise(volume, {weight(k, "down", "scale"), weight(k, "down", "shift")}, network, threads);
    } else {
      leaky_relu(volume, static_cast<float>(network.slope));
    }
    levels.push_back(volume);
  }
  for (int k = depth - 1, side = 4; k >= 0; --k, side *= 2) {
    if (k < depth - 1) {
      const Volume& level = levels[static_cast<std::size_t>(k)];
      volume.insert(volume.end(), level.begin(), level.end());
    }
    const int to = k == 0 ? 1 : channels[k - 1];
    const DecoderLayer layer{"", k == depth - 1 ? channels[k] : 2 * channels[k], to, side};
    const std::span<const float> bias =
        k == 0 ? std::span<const float>() : std::span<const float>(weight(k, "up", "bias"));
    volume = TransposedConvolution(layer, weight(k, "up", "weight"), bias)(volume, threads);
    if (k > 0) {
      normalise(volume, {weight(k, "up", "scale"), weight(k, "up", "shift")}, network, threads);
    }
  }
  VoxelGrid<float> field = unit_grid<float>(resolution);
  for (std::size_t n = 0; n < volume.size(); ++n) field.values[n] = unit * std::tanh(volume[n]);
  return field;
}

}  // namespace fracbench::neural
