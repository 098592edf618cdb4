#include "training/transposed_convolution.h"

#include <torch/torch.h>

#include <array>
#include <cstdint>

// Along each axis, window j of two inputs gives the outputs 2 j - 1 + q, q = 0 and 1, of which the
// first and the last lie outside. Its input a meets tap 2 (1 - a) + q of the kernel.
//
// Weights and volumes are put in order in one pass each way: as a chain of libtorch's operations
// this takes longer than all else in a step but the products.

namespace fracbench::training {

namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

constexpr std::int64_t kTaps = 64, kHalf = 8;

/// Where the taps of a kernel are among the windows' weights: parity q and input a, each as one
/// number of three bits.
struct Taps {
  std::array<std::int64_t, kTaps> q{}, a{};
};

constexpr Taps kPlaces = [] {
  Taps places;
  for (std::int64_t k = 0; k < kTaps; ++k) {
    for (int axis = 0; axis < 3; ++axis) {  // x, y, z
      const std::int64_t tap = k >> (2 * axis) & 3;
      places.q[k] |= (tap & 1) << axis;
      places.a[k] |= (1 - (tap >> 1)) << axis;
    }
  }
  return places;
}();

/// Calls visit(number in the weight, number in the windows) for all of them.
template <typename Visit>
void for_taps(std::int64_t in, std::int64_t out, const Visit& visit) {
#pragma omp parallel for num_threads(torch::get_num_threads())
  for (std::int64_t o = 0; o < out; ++o) {
    for (std::int64_t i = 0; i < in; ++i) {
      const std::int64_t from = (i * out + o) * kTaps, to = (o * kHalf * in + i) * kHalf;
      for (std::int64_t k = 0; k < kTaps; ++k) {
        visit(from + k, to + kPlaces.q[k] * in * kHalf + kPlaces.a[k]);
      }
    }
  }
}

/// The weights in x out x 4^3 as those of a convolution of kernel 2: (out, q) x in x 2^3.
class Windows : public torch::autograd::Function<Windows> {
 public:
  static torch::Tensor forward(AutogradContext* context, const torch::Tensor& weight) {
    const auto in = weight.size(0), out = weight.size(1);
    context->saved_data["in"] = in;
    context->saved_data["out"] = out;
    const torch::Tensor from = weight.contiguous();
    torch::Tensor windows = torch::empty({kHalf * out, in, 2, 2, 2}, weight.options());
    const float* source = from.data_ptr<float>();
    float* target = windows.data_ptr<float>();
    for_taps(in, out, [&](std::int64_t w, std::int64_t k) { target[k] = source[w]; });
    return windows;
  }

  static variable_list backward(AutogradContext* context, const variable_list& gradients) {
    const auto in = context->saved_data["in"].toInt(), out = context->saved_data["out"].toInt();
    const torch::Tensor from = gradients[0].contiguous();
    torch::Tensor weight = torch::empty({in, out, 4, 4, 4}, from.options());
    const float* source = from.data_ptr<float>();
    float* target = weight.data_ptr<float>();
    for_taps(in, out, [&](std::int64_t w, std::int64_t k) { target[w] = source[k]; });
    return {weight};
  }
};

/// Calls visit(first of a row of the volume, first of the row of even places, that of odd ones) for
/// all rows of 2 side voxels: place 2 k is even's k, place 2 k + 1 is odd's k + 1.
template <typename Visit>
void for_rows(std::int64_t channels, std::int64_t side, const Visit& visit) {
  const std::int64_t n = side + 1, length = 2 * side;
#pragma omp parallel for collapse(2) num_threads(torch::get_num_threads())
  for (std::int64_t c = 0; c < channels; ++c) {
    for (std::int64_t z = 0; z < length; ++z) {
      for (std::int64_t y = 0; y < length; ++y) {
        const std::int64_t q = (1 - z % 2) << 2 | (1 - y % 2) << 1;
        const std::int64_t row = ((z + 1) / 2 * n + (y + 1) / 2) * n;
        const std::int64_t odd = (c * kHalf + q) * n * n * n + row;
        visit(((c * length + z) * length + y) * length, odd + n * n * n, odd);
      }
    }
  }
}

/// Values of the windows, 1 x (channels, q) x (side + 1)^3, in their places: 1 x channels x
/// (2 side)^3.
class InPlaces : public torch::autograd::Function<InPlaces> {
 public:
  static torch::Tensor forward(AutogradContext*, const torch::Tensor& values) {
    const auto channels = values.size(1) / kHalf, side = values.size(2) - 1;
    const torch::Tensor from = values.contiguous();
    torch::Tensor volume =
        torch::empty({1, channels, 2 * side, 2 * side, 2 * side}, from.options());
    const float* source = from.data_ptr<float>();
    float* target = volume.data_ptr<float>();
    for_rows(channels, side, [&](std::int64_t row, std::int64_t even, std::int64_t odd) {
      for (std::int64_t k = 0; k < side; ++k) {
        target[row + 2 * k] = source[even + k];
        target[row + 2 * k + 1] = source[odd + k + 1];
      }
    });
    return volume;
  }

  static variable_list backward(AutogradContext*, const variable_list& gradients) {
    const torch::Tensor from = gradients[0].contiguous();
    const auto channels = from.size(1), side = from.size(2) / 2, n = side + 1;
    // What lies outside has no say: zero.
    torch::Tensor values = torch::zeros({1, kHalf * channels, n, n, n}, from.options());
    const float* source = from.data_ptr<float>();
    float* target = values.data_ptr<float>();
    for_rows(channels, side, [&](std::int64_t row, std::int64_t even, std::int64_t odd) {
      for (std::int64_t k = 0; k < side; ++k) {
        target[even + k] = source[row + 2 * k];
        target[odd + k + 1] = source[row + 2 * k + 1];
      }
    });
    return {values};
  }
};

/// The same by libtorch's own operations, on any device.
torch::Tensor windows_on_any_device(const torch::Tensor& weight) {
  const auto in = weight.size(0), out = weight.size(1);
  return weight
      .reshape({in, out, 2, 2, 2, 2, 2, 2})  // in, out, 1 - az, qz, and so on
      .flip({2, 4, 6})
      .permute({1, 3, 5, 7, 0, 2, 4, 6})  // out, qz, qy, qx, in, az, ay, ax
      .reshape({kHalf * out, in, 2, 2, 2});
}

torch::Tensor in_places_on_any_device(const torch::Tensor& values) {
  const auto out = values.size(1) / kHalf, n = values.size(2);
  return values.reshape({out, 2, 2, 2, n, n, n})
      .permute({0, 4, 1, 5, 2, 6, 3})
      .reshape({1, out, 2 * n, 2 * n, 2 * n})
      .slice(2, 1, 2 * n - 1)
      .slice(3, 1, 2 * n - 1)
      .slice(4, 1, 2 * n - 1);
}

}  // namespace

torch::Tensor transposed_convolution(const torch::Tensor& input, const torch::Tensor& weight) {
  if (!input.is_cpu()) {
    return in_places_on_any_device(torch::conv3d(input, windows_on_any_device(weight), {}, 1, 1));
  }
  return InPlaces::apply(torch::conv3d(input, Windows::apply(weight), {}, 1, 1));
}

}  // namespace fracbench::training
