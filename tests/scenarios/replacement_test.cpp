#include "scenarios/replacement.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/measures.h"
#include "tests/scenarios/test_bodies.h"

namespace fracbench {
namespace {

TEST(Replacement, KeepsMomentumAndEnergyOfASpinningBody) {
  const TriangleMesh mesh = test::box({1.9, 1.2, 1}, {0.3, -0.2, 0.1});
  const test::PlaneSplitter splitter(mesh,
                                     {{.normal = Vec3(1, 0.3, 0.1).normalized(), .offset = 0.2},
                                      {.normal = Vec3(0, 1, 0.4).normalized(), .offset = -0.1}});
  test::TestContext test;
  std::vector<MassFrame> frames;
  for (const Piece& piece : splitter.fracture({}, test.context)) {
    frames.push_back(mass_frame(mass_properties(piece.mesh), 1000));
  }
  ASSERT_EQ(frames.size(), 4u);
  const MassFrame whole = mass_frame(mass_properties(mesh), 1000);
  BodyState state;
  state.pose.position = {1, 2, 3};
  state.pose.orientation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized());
  state.velocity = {3, -20, 5};
  state.angular_velocity = {8, 2, -15};
  const Replacement kept = measure_replacement(0, state, whole, frames);
  EXPECT_LT(kept.momentum_error, 1e-12);
  EXPECT_LT(kept.angular_momentum_error, 1e-12);
  EXPECT_NEAR(kept.energy_ratio, 1, 1e-12);

  frames.pop_back();
  EXPECT_GT(measure_replacement(0, state, whole, frames).momentum_error, 0.01);
}

TEST(MassFrame, AndMeshFrameGoBackAndForthExactly) {
  const TriangleMesh mesh = test::box({1.9, 1.2, 1}, {0.3, -0.2, 0.1});
  const MassFrame frame = mass_frame(mass_properties(mesh), 1000);
  EXPECT_NEAR(frame.mass, 2280, 1e-9);
  Pose pose;
  pose.position = {1, 2, 3};
  pose.orientation = Eigen::AngleAxisd(2.1, Vec3(1, 2, 3).normalized());
  const Pose back = frame.mesh_pose(frame.body_pose(pose));
  EXPECT_LT((back.position - pose.position).norm(), 1e-14);
  EXPECT_LT(back.orientation.angularDistance(pose.orientation), 1e-14);
  const Vec3 point(0.4, 0.5, -0.6);
  EXPECT_LT((frame.body_pose(pose).to_world(frame.to_body(point)) - pose.to_world(point)).norm(),
            1e-14);
}

TEST(Replacement, RefusesTagsThatDoNotFitTheFaces) {
  std::vector<Piece> pieces(2);
  pieces[0].mesh = test::box({1, 1, 1});
  pieces[0].faces.resize(12);
  pieces[1] = pieces[0];
  const std::vector<FragmentFace> body(12);
  std::int32_t next = 0;
  EXPECT_NO_THROW(compose_faces(body, pieces, next));
  pieces[1].faces[3].parent_face = 12;
  EXPECT_THROW(compose_faces(body, pieces, next), MethodFailure);
  pieces[1].faces[3] = {.parent_face = -1, .neighbour = 1};
  EXPECT_THROW(compose_faces(body, pieces, next), MethodFailure);
  pieces[1].faces.pop_back();
  EXPECT_THROW(compose_faces(body, pieces, next), MethodFailure);
}

}  // namespace
}  // namespace fracbench
