#include "methods/bem/pair_kernel.h"

#include <cmath>

#include "methods/bem/processor_clones.h"

namespace fracbench::bem {
namespace {

constexpr int kMostPoints = 12;
// Added to squared distances, m^2: points of two crossing triangles that meet count as nothing.
constexpr double kTiny = 1e-100;

// Eight numbers side by side. Every operation is elementwise, so that the results are the same bits
// with any vector instructions.
using Lanes = double __attribute__((vector_size(sizeof(double) * kPairLanes), may_alias));

// One instruction for several lanes where this file is compiled without error numbers for
// mathematical functions (CMakeLists.txt sees to that).
__attribute__((always_inline)) inline void square_root(const Lanes& squared, Lanes& root) {
  alignas(64) double values[kPairLanes];
  *reinterpret_cast<Lanes*>(values) = squared;
  for (double& value : values) value = std::sqrt(value);
  root = *reinterpret_cast<const Lanes*>(values);
}

template <bool DoubleLayer>
__attribute__((always_inline)) inline void sum_batch(const PairBatch& batch,
                                                     std::span<const TrianglePoint> rule,
                                                     PairSums& sums) {
  Lanes test_points[kMostPoints][3];
  Lanes trial_points[kMostPoints][3];
  Lanes trial_sides[2][3];
  for (int c = 0; c < 3; ++c) {
    const Lanes test_corner = *reinterpret_cast<const Lanes*>(batch.test[c]);
    const Lanes test_u = *reinterpret_cast<const Lanes*>(batch.test[3 + c]);
    const Lanes test_v = *reinterpret_cast<const Lanes*>(batch.test[6 + c]);
    const Lanes trial_corner = *reinterpret_cast<const Lanes*>(batch.trial[c]);
    trial_sides[0][c] = *reinterpret_cast<const Lanes*>(batch.trial[3 + c]);
    trial_sides[1][c] = *reinterpret_cast<const Lanes*>(batch.trial[6 + c]);
    for (std::size_t q = 0; q < rule.size(); ++q) {
      test_points[q][c] = test_corner + rule[q].u * test_u + rule[q].v * test_v;
      trial_points[q][c] =
          trial_corner + rule[q].u * trial_sides[0][c] + rule[q].v * trial_sides[1][c];
    }
  }
  Lanes normal[3] = {};
  if constexpr (DoubleLayer) {
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3;
      const int e = (c + 2) % 3;
      normal[c] = trial_sides[0][d] * trial_sides[1][e] - trial_sides[0][e] * trial_sides[1][d];
    }
    const Lanes squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    Lanes length;
    square_root(squared, length);
    for (Lanes& component : normal) component /= length;
  }

  Lanes xx = {}, yy = {}, zz = {}, xy = {}, xz = {}, yz = {};
  Lanes layers[3] = {};
  for (std::size_t p = 0; p < rule.size(); ++p) {
    for (std::size_t q = 0; q < rule.size(); ++q) {
      const Lanes x = test_points[p][0] - trial_points[q][0];
      const Lanes y = test_points[p][1] - trial_points[q][1];
      const Lanes z = test_points[p][2] - trial_points[q][2];
      const Lanes squared = x * x + y * y + z * z + kTiny;
      Lanes cubed;
      square_root(squared, cubed);
      cubed *= squared;
      const Lanes factor = rule[p].weight * rule[q].weight / cubed;
      const Lanes fx = factor * x;
      const Lanes fy = factor * y;
      const Lanes fz = factor * z;
      xx += fx * x;
      yy += fy * y;
      zz += fz * z;
      xy += fx * y;
      xz += fx * z;
      yz += fy * z;
      if constexpr (DoubleLayer) {
        const Lanes layer = fx * normal[0] + fy * normal[1] + fz * normal[2];
        layers[0] += (1 - rule[q].u - rule[q].v) * layer;
        layers[1] += rule[q].u * layer;
        layers[2] += rule[q].v * layer;
      }
    }
  }
  const Lanes components[] = {xx, yy, zz, xy, xz, yz, layers[0], layers[1], layers[2]};
  for (int k = 0; k < (DoubleLayer ? 9 : 6); ++k) {
    *reinterpret_cast<Lanes*>(sums.values[k]) = components[k];
  }
}

}  // namespace

void PairBatch::set(int lane, const Corners& test_corners, const Corners& trial_corners) {
  for (int c = 0; c < 3; ++c) {
    test[c][lane] = test_corners[0][c];
    test[3 + c][lane] = test_corners[1][c] - test_corners[0][c];
    test[6 + c][lane] = test_corners[2][c] - test_corners[0][c];
    trial[c][lane] = trial_corners[0][c];
    trial[3 + c][lane] = trial_corners[1][c] - trial_corners[0][c];
    trial[6 + c][lane] = trial_corners[2][c] - trial_corners[0][c];
  }
}

FRACBENCH_PROCESSOR_CLONES("avx512f", "avx2", "default")
void sum_pairs(const PairBatch& batch, std::span<const TrianglePoint> rule, PairSums& sums) {
  sum_batch<false>(batch, rule, sums);
}

FRACBENCH_PROCESSOR_CLONES("avx512f", "avx2", "default")
void sum_pairs_with_double_layer(const PairBatch& batch, std::span<const TrianglePoint> rule,
                                 PairSums& sums) {
  sum_batch<true>(batch, rule, sums);
}

}  // namespace fracbench::bem
