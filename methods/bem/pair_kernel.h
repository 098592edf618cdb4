#pragma once

#include <array>
#include <span>

#include "methods/bem/boundary_elements.h"
#include "methods/bem/triangle_rules.h"

namespace fracbench::bem {

/// How many pairs of triangles one call works on: the lanes of a vector.
constexpr int kPairLanes = 8;

/// Pairs of triangles side by side: for each triangle of the pair, corner 0 and the two sides from
/// it, component by component.
struct PairBatch {
  alignas(64) double test[9][kPairLanes];
  alignas(64) double trial[9][kPairLanes];

  void set(int lane, const Corners& test_corners, const Corners& trial_corners);
};

/// Components of r r^T / |r|^3 in this order: xx, yy, zz, xy, xz, yz.
constexpr int kPairComponents = 6;
/// After them, in tables with the double layer: n_y . r / |r|^3 times the hat function of each of
/// the trial triangle's corners.
constexpr int kDoubleLayerComponents = 3;

/// Sums over the points of one rule on both triangles, as means (times the two areas they are
/// integrals): results[component][lane].
struct PairSums {
  alignas(64) double values[kPairComponents + kDoubleLayerComponents][kPairLanes];
};

/// r r^T / |r|^3 with r = x - y, x on the test triangle and y on the trial triangle.
void sum_pairs(const PairBatch& batch, std::span<const TrianglePoint> rule, PairSums& sums);

/// The same and the double layer. The normal is that of the trial triangle's corners in their
/// order.
void sum_pairs_with_double_layer(const PairBatch& batch, std::span<const TrianglePoint> rule,
                                 PairSums& sums);

}  // namespace fracbench::bem
