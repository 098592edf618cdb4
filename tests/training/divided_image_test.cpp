#include "training/divided_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fracbench::training {
namespace {

using neural::Representation;

TEST(DividedImage, DistanceIsThatToTheNearestPixelOfTheLinesTruncatedAtSixteenPixels) {
  constexpr int kSide = 64;
  Random random(3);
  const Labels labels = voronoi({.side = kSide, .least_sites = 2, .most_sites = 5}, random);
  const std::vector<float> lines = image_of(labels, Representation::lines, kSide);
  const std::vector<float> distance = image_of(labels, Representation::distance, kSide);
  bool truncated = false;
  for (int p = 0; p < kSide * kSide; ++p) {
    double nearest = 16;
    for (int q = 0; q < kSide * kSide; ++q) {
      if (lines[q] == 0) continue;
      nearest = std::min(nearest, std::hypot(p % kSide - q % kSide, p / kSide - q / kSide));
    }
    ASSERT_NEAR(distance[p], nearest / 16, 1e-6) << p;
    truncated |= distance[p] == 1;
  }
  EXPECT_TRUE(truncated);
}

TEST(DividedImage, RegionsAreCalledInTheOrderInWhichTheyAppear) {
  EXPECT_EQ(in_order({7, 7, 2, 7, -1, 2}), (Labels{0, 0, 1, 0, 2, 1}));
  EXPECT_EQ(count_of({7, 7, 2, 7, -1, 2}), 3);
}

}  // namespace
}  // namespace fracbench::training
