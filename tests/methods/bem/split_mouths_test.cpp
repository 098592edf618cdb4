#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/measures.h"
#include "methods/bem/cracked_surface.h"
#include "methods/bem/validation/crack_meshes.h"

namespace fracbench::bem {
namespace {

TEST(ValidationBodies, AreClosedAndTheirCracksPointTheRightWay) {
  const CrackedBody strip = edge_cracked_strip({.depth = 0.3, .half_height = 1.5});
  EXPECT_NEAR(volume(strip.surface), 3 * 0.1, 1e-12);
  EXPECT_GT(area_vector2(strip.crack.mesh, 0).y(), 0);
  EXPECT_NEAR(area(strip.crack.mesh), 0.3 * 0.1, 1e-12);
  const CrackedBody block = half_penny_block(4, 5);
  EXPECT_NEAR(volume(block.surface), 8 * 8 * 4, 1e-9);
  for (std::size_t f = 0; f < block.crack.mesh.faces.size(); ++f) {
    EXPECT_GT(area_vector2(block.crack.mesh, f).y(), 0);
  }
  EXPECT_NEAR(area(block.crack.mesh), 15.0 / 2 * std::sin(M_PI / 15), 1e-12);
}

TEST(SplitMouths, DoublesTheMouthAndLeavesItsTips) {
  const CrackedBody block = half_penny_block(4, 5);
  const CrackedSurface cracked = split_mouths(block.surface, {&block.crack, 1});
  // 11 vertices on the diameter, the two ends stay single.
  EXPECT_EQ(cracked.surface.vertices.size(), block.surface.vertices.size() + 9);
  EXPECT_EQ(cracked.surface.faces.size(), block.surface.faces.size());
  EXPECT_EQ(cracked.mouths.size(), 11u);
  EXPECT_EQ(cracked.overshooting, 0);
  int tips = 0;
  for (const MouthVertex& mouth : cracked.mouths) {
    const Vec3& at = cracked.sheets[0].mesh.vertices[mouth.vertex];
    EXPECT_EQ(cracked.surface.vertices[mouth.upper[0]], at);
    EXPECT_EQ(cracked.surface.vertices[mouth.lower[0]], at);
    EXPECT_EQ(mouth.upper[0], mouth.upper[1]);
    EXPECT_EQ(mouth.lower[0], mouth.lower[1]);
    if (mouth.upper[0] == mouth.lower[0]) {
      ++tips;
      EXPECT_EQ(std::abs(at.x()), 1);
    }
  }
  EXPECT_EQ(tips, 2);
}

TEST(SplitMouths, PutsTheUpperSideWhereTheNormalPoints) {
  for (const bool strip : {false, true}) {
    const CrackedBody body = strip ? edge_cracked_strip({}) : half_penny_block(4, 5);
    const CrackedSurface cracked = split_mouths(body.surface, {&body.crack, 1});
    for (const MouthVertex& mouth : cracked.mouths) {
      if (mouth.upper[0] == mouth.lower[0]) continue;
      for (const Face& face : cracked.surface.faces) {
        Vec3 center = Vec3::Zero();
        for (const std::int32_t v : face) center += cracked.surface.vertices[v] / 3;
        const auto has = [&](std::int32_t v) { return std::ranges::find(face, v) != face.end(); };
        EXPECT_FALSE(has(mouth.upper[0]) && center.y() < 0);
        EXPECT_FALSE(has(mouth.lower[0]) && center.y() > 0);
      }
    }
  }
}

TEST(SplitMouths, CountsCracksThatEndAtTheSurfaceWithoutAMouth) {
  CrackedBody block = half_penny_block(4, 5);
  for (Vec3& vertex : block.crack.mesh.vertices) vertex.z() += 0.1;
  const CrackedSurface cracked = split_mouths(block.surface, {&block.crack, 1});
  EXPECT_EQ(cracked.overshooting, 1);
  EXPECT_TRUE(cracked.mouths.empty());
  EXPECT_EQ(cracked.surface.vertices.size(), block.surface.vertices.size());
}

}  // namespace
}  // namespace fracbench::bem
