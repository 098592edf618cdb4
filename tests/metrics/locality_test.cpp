#include "metrics/locality.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;

/// Slices of a bar along x, of these lengths.
Fragments slices(const std::vector<double>& lengths) {
  Fragments fragments;
  double x = 0;
  for (const double length : lengths) {
    fragments.push_back(whole(box(Vec3(x, 0, 0), Vec3(x + length, 1, 1))));
    x += length;
  }
  return fragments;
}

Measurement measured(const std::vector<double>& lengths, const Vec3& point) {
  Impact hit = impact(Vec3::UnitX());
  hit.impulses.front().point = point;
  const std::vector<Impact> impacts{hit};
  const Fragments fragments = slices(lengths);
  return Locality().measure(cell(box(Vec3::Zero(), Vec3(15, 1, 1)), fragments, impacts));
}

TEST(Locality, IsOneWhereFragmentsGrowAwayFromTheImpact) {
  const std::vector<double> growing{1, 2, 3, 4, 5};
  EXPECT_NEAR(value(measured(growing, Vec3(0, 0.5, 0.5)), "size_distance_correlation"), 1, 1e-12);
  EXPECT_NEAR(value(measured(growing, Vec3(15, 0.5, 0.5)), "size_distance_correlation"), -1, 1e-12);
}

TEST(Locality, IsThatOfTheRanks) {
  // Ranks of the volumes along the bar: 2 1 4 3. Spearman: 1 - 6 * 4 / (4 * 15) = 0.6.
  EXPECT_NEAR(value(measured({2, 1, 4, 3}, Vec3(0, 0.5, 0.5)), "size_distance_correlation"), 0.6,
              1e-12);
}

TEST(Locality, IsLeftOutWhereItSaysNothing) {
  EXPECT_FALSE(has(measured({5, 10}, Vec3::Zero()), "size_distance_correlation"));
  // 2^-k lengths, so that the volumes are equal bit for bit.
  EXPECT_FALSE(has(measured({4, 4, 4}, Vec3::Zero()), "size_distance_correlation"));
  const Fragments fragments = slices({1, 2, 3});
  EXPECT_FALSE(has(Locality().measure(cell(box(), fragments)), "size_distance_correlation"));
}

}  // namespace
}  // namespace fracbench
