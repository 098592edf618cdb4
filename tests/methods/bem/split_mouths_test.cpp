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
    EXPECT_EQ(cracked.surface.vertices[mouth.upper], at);
    EXPECT_EQ(cracked.surface.vertices[mouth.lower], at);
    if (mouth.upper == mouth.lower) {
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
      if (mouth.upper == mouth.lower) continue;
      for (const Face& face : cracked.surface.faces) {
        Vec3 center = Vec3::Zero();
        for (const std::int32_t v : face) center += cracked.surface.vertices[v] / 3;
        const auto has = [&](std::int32_t v) { return std::ranges::find(face, v) != face.end(); };
        EXPECT_FALSE(has(mouth.upper) && center.y() < 0);
        EXPECT_FALSE(has(mouth.lower) && center.y() > 0);
      }
    }
  }
}

TEST(SplitMouths, StaysClosedWhereTwoMouthsMeet) {
  // A second crack in the plane x = 0, whose mouth crosses the first one's in the origin.
  const CrackedBody block = half_penny_block(4, 5);
  CrackSheet other = block.crack;
  other.mesh = {};
  std::vector<Vec3> line;
  for (const Vec3& v : block.surface.vertices) {
    if (v.z() == 0 && v.x() == 0 && std::abs(v.y()) < 1) line.push_back(v);
  }
  std::ranges::sort(line, {}, [](const Vec3& v) { return v.y(); });
  ASSERT_GE(line.size(), 3u);
  other.mesh.vertices = line;
  other.mesh.vertices.emplace_back(0, 0, -0.5);
  const auto apex = static_cast<std::int32_t>(line.size());
  for (std::int32_t i = 0; i < apex; ++i) {
    if (i + 1 < apex) other.mesh.faces.push_back({i, apex, i + 1});
  }
  other.boundary = boundary_loop(other.mesh);
  other.states.assign(other.boundary.size(), FrontState::at_surface);
  const std::vector<CrackSheet> cracks{block.crack, other};
  const CrackedSurface cracked = split_mouths(block.surface, cracks);
  int closed = 0;
  for (const MouthVertex& mouth : cracked.mouths) {
    const Vec3& at = cracked.sheets[mouth.sheet].mesh.vertices[mouth.vertex];
    EXPECT_TRUE(at.norm() > 0 || mouth.upper == mouth.lower);
    closed += at.norm() == 0 ? 1 : 0;
  }
  EXPECT_EQ(closed, 2);
  EXPECT_EQ(cracked.surface.vertices.size(), block.surface.vertices.size() + 8 + line.size() - 3);
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
