#include "neural/transposed_convolution.h"

#include <cblas.h>

#include <algorithm>
#include <cstring>

#include "neural/blas_threads.h"

namespace fracbench::neural {

namespace {

constexpr int kTaps = 64;
// Columns of a product: enough to run at full speed, few enough for the columns to stay small.
constexpr std::size_t kColumns = 1024;
// Layers of outputs of the only channel that a thread makes at a time.
constexpr int kOutputLayers = 8;

std::size_t cube(int side) { return static_cast<std::size_t>(side) * side * side; }

/// Volumes of their own each: a copy of one would touch its pages before the threads do.
std::vector<Volume> untouched(int count, std::size_t size) {
  std::vector<Volume> volumes;
  for (int k = 0; k < count; ++k) volumes.emplace_back(size);
  return volumes;
}

/// Tap of the kernel that takes input `a` of a window (0: the lower one) to output of parity `p`.
int tap(int p, int a) { return 3 - p - 2 * a; }

/// One layer of windows [channel][a_z][a_y][a_x][(side + 1)^2], between input layers z - 1 and z.
void gather_windows(std::span<const float> input, int channels, int side, int z, std::size_t stride,
                    float* columns) {
  const int windows = side + 1;
  for (int c = 0; c < channels; ++c) {
    const float* volume = &input[static_cast<std::size_t>(c) * cube(side)];
    for (int a = 0; a < 8; ++a) {
      const int plane = z - 1 + (a >> 2), ay = (a >> 1) & 1, ax = a & 1;
      float* out =
          columns + (static_cast<std::size_t>(c) * 8 + static_cast<std::size_t>(a)) * stride;
      for (int y = 0; y < windows; ++y, out += windows) {
        const int row = y - 1 + ay;
        if (plane < 0 || plane >= side || row < 0 || row >= side) {
          std::fill_n(out, windows, 0.0f);
          continue;
        }
        const float* from = volume + (static_cast<std::size_t>(plane) * side + row) * side;
        out[ax == 0 ? 0 : side] = 0;
        std::memcpy(out + 1 - ax, from, static_cast<std::size_t>(side) * sizeof(float));
      }
    }
  }
}

/// Puts what one layer of windows gave where it belongs.
void scatter_windows(const float* values, std::size_t stride, int channels, int side, int z,
                     const std::vector<float>& bias, std::span<float> output) {
  const int windows = side + 1, out_side = 2 * side;
  for (int c = 0; c < channels; ++c) {
    const float shift = bias.empty() ? 0.0f : bias[static_cast<std::size_t>(c)];
    float* volume = &output[static_cast<std::size_t>(c) * cube(out_side)];
    for (int p = 0; p < 8; ++p) {
      const int pz = p >> 2, py = (p >> 1) & 1, px = p & 1;
      const int plane = 2 * z - pz;
      if (plane < 0 || plane >= out_side) continue;
      const float* from =
          values + (static_cast<std::size_t>(c) * 8 + static_cast<std::size_t>(p)) * stride;
      for (int y = py; y < side + py; ++y) {
        const float* in = from + static_cast<std::size_t>(y) * windows + px;
        float* out =
            volume + (static_cast<std::size_t>(plane) * out_side + (2 * y - py)) * out_side + px;
        for (int x = 0; x < side; ++x) out[2 * x] = in[x] + shift;
      }
    }
  }
}

}  // namespace

TransposedConvolution::TransposedConvolution(const DecoderLayer& layer,
                                             std::span<const float> weight,
                                             std::span<const float> bias)
    : layer_(layer), bias_(bias.begin(), bias.end()) {
  const auto at = [&](int ci, int co, int kz, int ky, int kx) {
    return weight[((static_cast<std::size_t>(ci) * layer.out + co) * 4 + kz) * 16 + ky * 4 + kx];
  };
  if (layer.out == 1) {  // [tap][in]
    for (int k = 0; k < kTaps; ++k) {
      for (int ci = 0; ci < layer.in; ++ci) {
        matrix_.push_back(at(ci, 0, k / 16, k / 4 % 4, k % 4));
      }
    }
    return;
  }
  matrix_.reserve(static_cast<std::size_t>(layer.out) * layer.in * kTaps);
  for (int co = 0; co < layer.out; ++co) {
    for (int p = 0; p < 8; ++p) {
      for (int ci = 0; ci < layer.in; ++ci) {
        for (int a = 0; a < 8; ++a) {
          matrix_.push_back(
              at(ci, co, tap(p >> 2, a >> 2), tap((p >> 1) & 1, (a >> 1) & 1), tap(p & 1, a & 1)));
        }
      }
    }
  }
}

Volume TransposedConvolution::operator()(std::span<const float> input, int threads) const {
  openblas_set_num_threads(threads);
  return layer_.out == 1 ? one_output(input, threads) : many_outputs(input, threads);
}

Volume TransposedConvolution::many_outputs(std::span<const float> input, int threads) const {
  const int side = layer_.side;
  const std::size_t plane = static_cast<std::size_t>(side + 1) * (side + 1);
  // As many products of about kColumns columns as it takes; an even number, for an even number of
  // threads. They do not depend on the number of threads, nor does the result.
  const int most = static_cast<int>(
      std::clamp<std::size_t>(kColumns / plane, 1, static_cast<std::size_t>(side)));
  const int products = (side + most) / most + (side + most) / most % 2;
  const int layers = (side + products) / products;
  const std::size_t width = plane * static_cast<std::size_t>(layers);
  const std::size_t rows_in = static_cast<std::size_t>(layer_.in) * 8;
  const std::size_t rows_out = static_cast<std::size_t>(layer_.out) * 8;
  std::vector<Volume> buffers =
      untouched(std::clamp(threads, 1, products), (rows_in + rows_out) * width);
  Volume output(static_cast<std::size_t>(layer_.out) * cube(2 * side));
  on_blas_threads(
      static_cast<std::size_t>(products), threads, [&](std::size_t n, std::size_t thread) {
        float* columns = buffers[thread].data();
        float* values = columns + rows_in * width;
        const int first = static_cast<int>(n) * layers, count = std::min(layers, side + 1 - first);
        if (count <= 0) return;
        for (int k = 0; k < count; ++k) {
          gather_windows(input, layer_.in, side, first + k, width,
                         columns + static_cast<std::size_t>(k) * plane);
        }
        cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(rows_out),
                    static_cast<int>(plane) * count, static_cast<int>(rows_in), 1.0f,
                    matrix_.data(), static_cast<int>(rows_in), columns, static_cast<int>(width),
                    0.0f, values, static_cast<int>(width));
        for (int k = 0; k < count; ++k) {
          scatter_windows(values + static_cast<std::size_t>(k) * plane, width, layer_.out, side,
                          first + k, bias_, output);
        }
      });
  return output;
}

// With one output, a product over windows would have eight rows only and copy every input eight
// times: instead, all taps of each input at once, then their sums.
Volume TransposedConvolution::one_output(std::span<const float> input, int threads) const {
  const int side = layer_.side, out_side = 2 * side;
  const std::size_t plane = static_cast<std::size_t>(side) * side;
  std::vector<Volume> buffers = untouched(std::max(1, threads), kTaps * plane);
  Volume output(cube(out_side));
  const auto parts = static_cast<std::size_t>((out_side + kOutputLayers - 1) / kOutputLayers);
  on_blas_threads(parts, threads, [&](std::size_t part, std::size_t thread) {
    const int first = static_cast<int>(part) * kOutputLayers;
    const int end = std::min(first + kOutputLayers, out_side);
    const std::size_t square = static_cast<std::size_t>(out_side) * out_side;
    std::fill_n(&output[static_cast<std::size_t>(first) * square],
                static_cast<std::size_t>(end - first) * square, bias_.empty() ? 0.0f : bias_[0]);
    // Input layer z reaches the outputs 2 z - 1 to 2 z + 2, by the taps 0 to 3.
    for (int z = std::max(0, first / 2 - 1); z <= std::min(side - 1, end / 2); ++z) {
      const int from_tap = std::max(0, first - 2 * z + 1), to_tap = std::min(4, end - 2 * z + 1);
      float* values = buffers[thread].data();
      cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, 16 * (to_tap - from_tap),
                  static_cast<int>(plane), layer_.in, 1.0f,
                  matrix_.data() + static_cast<std::size_t>(16 * from_tap * layer_.in), layer_.in,
                  input.data() + static_cast<std::size_t>(z) * plane, static_cast<int>(cube(side)),
                  0.0f, values, static_cast<int>(plane));
      for (int k = 16 * from_tap; k < 16 * to_tap; ++k, values += plane) {
        const int oz = 2 * z - 1 + k / 16, dy = k / 4 % 4 - 1, dx = k % 4 - 1;
        for (int y = 0; y < side; ++y) {
          const int oy = 2 * y + dy;
          if (oy < 0 || oy >= out_side) continue;
          const float* in = values + static_cast<std::size_t>(y) * side;
          float* out = &output[(static_cast<std::size_t>(oz) * out_side + oy) * out_side];
          const int from = dx < 0 ? 1 : 0, to = dx > 1 ? side - 1 : side;
          for (int x = from; x < to; ++x) out[2 * x + dx] += in[x];
        }
      }
    }
  });
  return output;
}

}  // namespace fracbench::neural
