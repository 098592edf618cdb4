#include "scenarios/contact_capture.h"

#include <gtest/gtest.h>

#include "geometry/measures.h"
#include "tests/scenarios/test_bodies.h"

namespace fracbench {
namespace {

class ContactCapture : public ::testing::Test {
 protected:
  CapturedImpulses capture(const std::vector<BodyContact>& contacts) const {
    const std::vector<StrikerBody> strikers(
        contacts.size(), {.mass = 2000, .radius = 0.4, .material = {}, .state = {}});
    return capture_impulses(
        contacts, strikers,
        {.mesh = &mesh, .surface = &surface, .frame = &frame, .state = {}, .region_size = 0.1});
  }

  TriangleMesh mesh = test::box({2, 2, 2});
  SurfaceTree surface{mesh};
  MassFrame frame = mass_frame(mass_properties(mesh), 1000);
};

TEST_F(ContactCapture, MergesAnImpulseThatTheEngineSplits) {
  const auto whole =
      capture({{.body = 0, .other = 1, .point = {1, 0.3, 0}, .impulse = {-80, 0, 8}}});
  std::vector<BodyContact> parts;
  for (const double dy : {-0.03, -0.01, 0.01, 0.03}) {
    parts.push_back({.body = 0, .other = 1, .point = {1, 0.3 + dy, 0}, .impulse = {-20, 0, 2}});
  }
  const auto merged = capture(parts);
  ASSERT_EQ(merged.impulses.size(), 1u);
  EXPECT_NEAR(merged.impulses[0].magnitude, whole.impulses[0].magnitude, 1e-12);
  EXPECT_LT((merged.impulses[0].point - whole.impulses[0].point).norm(), 1e-12);
  EXPECT_LT((merged.impulses[0].direction - whole.impulses[0].direction).norm(), 1e-12);
}

TEST_F(ContactCapture, KeepsRegionsAndStrikersApartAndSortsThemByStrength) {
  const auto captured = capture({
      {.body = 0, .other = 1, .point = {1, 0.9, 0}, .impulse = {-10, 0, 0}},
      {.body = 0, .other = 1, .point = {1, -0.9, 0}, .impulse = {-30, 0, 0}},
      {.body = 0, .other = 2, .point = {1, -0.9, 0}, .impulse = {-20, 0, 0}},
  });
  ASSERT_EQ(captured.impulses.size(), 3u);
  EXPECT_EQ(captured.impulses[0].magnitude, 30);
  EXPECT_EQ(captured.impulses[1].magnitude, 20);
  EXPECT_EQ(captured.impulses[2].magnitude, 10);
}

TEST_F(ContactCapture, PutsThePointOnTheSurfaceAndNamesItsFace) {
  const auto captured =
      capture({{.body = 0, .other = 1, .point = {0.97, 0.2, 0.1}, .impulse = {-10, 0, 0}}});
  const Impulse& impulse = captured.impulses.at(0);
  EXPECT_LT((impulse.point - Vec3(1, 0.2, 0.1)).norm(), 1e-12);
  EXPECT_LT((impulse.normal - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(impulse.face_area, 2, 1e-12);
  EXPECT_EQ(impulse.direction, Vec3(-1, 0, 0));
}

}  // namespace
}  // namespace fracbench
