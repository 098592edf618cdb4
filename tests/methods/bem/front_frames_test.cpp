#include "methods/bem/front_frames.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "core/error.h"
#include "methods/bem/validation/crack_meshes.h"

namespace fracbench::bem {
namespace {

TEST(FrontFrames, OfADiscPointOutwardsUpwardsAndAlongTheFront) {
  const Mat3 turn = Eigen::AngleAxisd(0.9, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  CrackSheet disc = disc_crack(0.3, 4);
  for (Vec3& vertex : disc.mesh.vertices) vertex = turn * vertex + Vec3(1, 2, 3);
  const std::vector<FrontFrame> frames = front_frames(disc);
  ASSERT_EQ(frames.size(), 24u);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Vec3 at = disc.mesh.vertices[disc.boundary[i]] - Vec3(1, 2, 3);
    EXPECT_LT((frames[i].forward - at / 0.3).norm(), 1e-12);
    EXPECT_LT((frames[i].normal - turn.col(2)).norm(), 1e-12);
    EXPECT_LT((frames[i].tangent - frames[i].forward.cross(frames[i].normal)).norm(), 1e-12);
  }
}

TEST(FrontFrames, AreExactForUnevenVerticesOnACircle) {
  CrackSheet disc = disc_crack(1, 3);
  for (std::size_t i = 0; i < disc.boundary.size(); ++i) {
    const double angle = 2 * std::numbers::pi * (i + (i % 3 == 1 ? 0.4 : 0)) / 18;
    disc.mesh.vertices[disc.boundary[i]] = Vec3(std::cos(angle), std::sin(angle), 0);
  }
  const std::vector<FrontFrame> frames = front_frames(disc);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_LT((frames[i].forward - disc.mesh.vertices[disc.boundary[i]]).norm(), 1e-12);
  }
}

TEST(FrontFrames, AtACornerBetweenFrontAndMouthFollowTheFront) {
  CrackSheet square;  // two triangles, mouth along x = 0, front at x = 1
  square.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  square.boundary = {0, 1, 2, 3};
  square.states = {FrontState::at_surface, FrontState::at_surface, FrontState::advancing,
                   FrontState::at_surface};
  const std::vector<FrontFrame> frames = front_frames(square);
  EXPECT_LT((frames[1].forward - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((frames[1].tangent - Vec3(0, -1, 0)).norm(), 1e-12);
  EXPECT_LT((frames[3].forward - Vec3(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((frames[2].forward - Vec3(1, 1, 0).normalized()).norm(), 1e-12);
}

TEST(FrontFrames, TakeThoseOfANeighbourWhereAVertexHasNoPlane) {
  CrackSheet disc = disc_crack(1, 2);
  const std::vector<FrontFrame> whole = front_frames(disc);
  // The boundary turns back on itself at vertex 3: its tangent has no direction.
  disc.mesh.vertices[disc.boundary[4]] = disc.mesh.vertices[disc.boundary[2]];
  const std::vector<FrontFrame> frames = front_frames(disc);
  EXPECT_LT((frames[3].normal - whole[3].normal).norm(), 1e-12);
  for (const FrontFrame& frame : frames) {
    EXPECT_NEAR(frame.forward.cross(frame.normal).dot(frame.tangent), 1, 1e-12);
  }
}

TEST(FrontFrames, SayWhereASheetIsNoSheet) {
  CrackSheet disc = disc_crack(1, 2);
  disc.states.pop_back();
  EXPECT_THROW(front_frames(disc), InputError);
  disc = disc_crack(1, 2);
  disc.boundary[3] = 99;
  EXPECT_THROW(front_frames(disc), InputError);
  disc = disc_crack(1, 2);
  for (Vec3& vertex : disc.mesh.vertices) vertex = Vec3(1, 1, 1);
  EXPECT_THROW(front_frames(disc), MethodFailure);
}

TEST(SheetArea, IsThatOfTheInscribedPolygon) {
  const double sides = 48;
  const double expected = sides / 2 * std::sin(2 * std::numbers::pi / sides);
  EXPECT_NEAR(sheet_area(disc_crack(1, 8)), expected, 1e-12);
  EXPECT_NEAR(sheet_area(disc_crack(1, 8, 1)), expected, 1e-12);
}

}  // namespace
}  // namespace fracbench::bem
