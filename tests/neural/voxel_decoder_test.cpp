#include "neural/voxel_decoder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "neural/transposed_convolution.h"

namespace fracbench::neural {
namespace {

std::vector<float> random_values(std::size_t count, Random& random) {
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(random.uniform(-1, 1));
  return values;
}

/// Straight from the definition: input i reaches output 2 i - 1 + k by tap k along each axis.
std::vector<double> by_definition(const DecoderLayer& layer, const std::vector<float>& weight,
                                  const std::vector<float>& bias, const std::vector<float>& input) {
  const int side = layer.side, n = 2 * side;
  std::vector<double> output(static_cast<std::size_t>(layer.out) * n * n * n);
  for (int co = 0; co < layer.out; ++co) {
    double* const volume = &output[static_cast<std::size_t>(co) * n * n * n];
    for (int at = 0; at < n * n * n; ++at) volume[at] = bias.empty() ? 0 : bias[co];
    for (int ci = 0; ci < layer.in; ++ci) {
      for (int i = 0; i < side * side * side; ++i) {
        const double value = input[static_cast<std::size_t>(ci) * side * side * side + i];
        for (int k = 0; k < 64; ++k) {
          const int x = 2 * (i % side) - 1 + k % 4, y = 2 * (i / side % side) - 1 + k / 4 % 4,
                    z = 2 * (i / (side * side)) - 1 + k / 16;
          if (x < 0 || y < 0 || z < 0 || x >= n || y >= n || z >= n) continue;
          volume[(z * n + y) * n + x] +=
              value * weight[(static_cast<std::size_t>(ci) * layer.out + co) * 64 + k];
        }
      }
    }
  }
  return output;
}

// Sides around those at which the work is divided differently: one product, several, a layer each.
TEST(TransposedConvolution, IsThatOfTheDefinitionForAnySideAndNumberOfThreads) {
  Random random(3);
  for (const int out : {1, 3}) {
    for (const int side : {1, 2, 3, 4, 5, 8, 9, 17, 31, 33}) {
      const DecoderLayer layer{.name = "x", .in = 2, .out = out, .side = side};
      const auto weight = random_values(static_cast<std::size_t>(layer.in * out) * 64, random);
      const auto bias = random_values(static_cast<std::size_t>(out), random);
      const auto input =
          random_values(static_cast<std::size_t>(layer.in * side * side) * side, random);
      const auto expected = by_definition(layer, weight, bias, input);
      const TransposedConvolution convolution(layer, weight, bias);
      const Volume output = convolution(input, 1);
      ASSERT_EQ(output.size(), expected.size());
      double largest = 0;
      for (std::size_t k = 0; k < output.size(); ++k) {
        largest = std::max(largest, std::abs(expected[k] - output[k]));
      }
      // Sums of 17 numbers below 1 in single precision.
      EXPECT_LT(largest, 17 * 17 * 6e-8) << out << " of side " << side;
      for (const int threads : {2, 3, 16}) EXPECT_EQ(convolution(input, threads), output) << side;
    }
  }
}

}  // namespace
}  // namespace fracbench::neural
