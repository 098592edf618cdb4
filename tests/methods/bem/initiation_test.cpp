#include "methods/bem/initiation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace fracbench::bem {
namespace {

const StrengthField kStrength{StrengthOptions{.mean = 1e6}};

/// Elements along x, one metre apart, with these principal stresses along x, y, z.
SurfaceStress row(const std::vector<Vec3>& principal, const Mat3& rotation = Mat3::Identity()) {
  SurfaceStress surface;
  for (std::size_t i = 0; i < principal.size(); ++i) {
    surface.centers.push_back(rotation * Vec3(static_cast<double>(i), 0, 0));
    surface.normals.push_back(rotation * Vec3(0, 0, 1));
    surface.stress.push_back(rotation * principal[i].asDiagonal() * rotation.transpose());
  }
  return surface;
}

TEST(Initiation, TakesTheHighestExcessFirstAndNothingBelowTheStrength) {
  const auto seeds =
      initiate(row({{1.5e6, 0, 0}, {0, 3e6, 0}, {0.99e6, 0, 0}, {0, 2e6, 1e6}}), kStrength, {}, {});
  ASSERT_EQ(seeds.size(), 3u);
  EXPECT_EQ(seeds[0].element, 1u);
  EXPECT_EQ(seeds[1].element, 3u);
  EXPECT_EQ(seeds[2].element, 0u);
  EXPECT_NEAR(seeds[0].excess, 3, 1e-12);
  EXPECT_NEAR(std::abs(seeds[0].normal.y()), 1, 1e-12);
  EXPECT_NEAR(std::abs(seeds[2].normal.x()), 1, 1e-12);
}

TEST(Initiation, StopsAtTheGreatestNumberOfCracks) {
  const std::vector<Vec3> equal(20, Vec3(2e6, 0, 0));
  InitiationOptions options;
  options.max_cracks = 4;
  const auto seeds = initiate(row(equal), kStrength, {}, options);
  ASSERT_EQ(seeds.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(seeds[i].element, i);  // ties: the first
}

TEST(Initiation, KeepsItsDistanceFromCracksAndFromOtherStarts) {
  const std::vector<Vec3> equal(10, Vec3(2e6, 0, 0));
  InitiationOptions options;
  options.max_cracks = 100;
  options.min_distance = 2.5;
  const std::vector<Vec3> occupied{Vec3(9, 0, 0.1)};
  const auto seeds = initiate(row(equal), kStrength, occupied, options);
  ASSERT_EQ(seeds.size(), 3u);  // 0, 3, 6
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(seeds[i].element, 3 * i);
}

TEST(Initiation, CountsCompressionOverItsFactor) {
  const std::vector<Vec3> stress{{0, -5.9e6, -1e6}, {-1e6, 0.1e6, -12e6}};  // excess 0.98 and 2
  const auto seeds = initiate(row(stress), kStrength, {}, {});
  ASSERT_EQ(seeds.size(), 1u);
  EXPECT_EQ(seeds[0].element, 1u);
  EXPECT_TRUE(seeds[0].compressed);
  EXPECT_NEAR(seeds[0].excess, 2, 1e-12);
  EXPECT_EQ(seeds[0].stress, -12e6);
  EXPECT_NEAR(std::abs(seeds[0].normal.z()), 1, 1e-12);
}

TEST(Initiation, UnderParityTakesAbsoluteValuesAndTheirDirection) {
  const std::vector<Vec3> stress{{0, -5.9e6, -1e6}, {3e6, 0, -2e6}};
  InitiationOptions options;
  options.parity = true;
  const auto seeds = initiate(row(stress), kStrength, {}, options);
  ASSERT_EQ(seeds.size(), 2u);
  EXPECT_EQ(seeds[0].element, 0u);
  EXPECT_NEAR(seeds[0].excess, 5.9, 1e-12);
  EXPECT_TRUE(seeds[0].compressed);
  EXPECT_NEAR(std::abs(seeds[0].normal.y()), 1, 1e-12);
  EXPECT_NEAR(std::abs(seeds[1].normal.x()), 1, 1e-12);
}

TEST(Initiation, TurnsWithTheBody) {
  const std::vector<Vec3> stress{{2e6, 1e6, -1e6}, {1e5, 3e6, 0}};
  const Mat3 rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const auto straight = initiate(row(stress), kStrength, {}, {});
  const auto turned = initiate(row(stress, rotation), kStrength, {}, {});
  ASSERT_EQ(straight.size(), turned.size());
  for (std::size_t i = 0; i < straight.size(); ++i) {
    EXPECT_EQ(straight[i].element, turned[i].element);
    EXPECT_NEAR(std::abs(turned[i].normal.dot(rotation * straight[i].normal)), 1, 1e-9);
    EXPECT_NEAR(straight[i].excess, turned[i].excess, 1e-9);
  }
}

TEST(Initiation, RefusesWhatItCannotJudge) {
  SurfaceStress surface = row({{2e6, 0, 0}});
  surface.stress[0](0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(initiate(surface, kStrength, {}, {}), MethodFailure);
  surface = row({{2e6, 0, 0}});
  surface.centers.clear();
  EXPECT_THROW(initiate(surface, kStrength, {}, {}), InputError);
}

}  // namespace
}  // namespace fracbench::bem
